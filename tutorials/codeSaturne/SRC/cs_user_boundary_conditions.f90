! Hot air enters at 5 m/s and leaves at the far end of the duct; walls are adiabatic.

subroutine cs_f_user_boundary_conditions &
 ( nvar   , nscal  , icodcl , itrifb , itypfb , izfppp , dt     , rcodcl )

use paramx
use numvar
use optcal
use cstphy
use entsor
use ppppar
use ppthch
use coincl
use cpincl
use ppincl
use ppcpfu
use mesh

implicit none

integer          nvar, nscal
integer          icodcl(nfabor,nvar)
integer          itrifb(nfabor), itypfb(nfabor)
integer          izfppp(nfabor)
double precision dt(ncelet)
double precision rcodcl(nfabor,nvar,3)

integer          kind, n, list_size, face
integer          face_types(4)
character(len=6) groups(4)
integer, allocatable, dimension(:) :: list

groups = (/ '1 or 2', '3     ', '4 or 5', '6     ' /)
face_types = (/ ientre, isolib, iparoi, isymet /)

allocate(list(nfabor))
do kind = 1, 4
  call getfbr(trim(groups(kind)), list_size, list)
  do n = 1, list_size
    face = list(n)
    itypfb(face) = face_types(kind)
    izfppp(face) = kind
    if (kind == 1) then
      rcodcl(face,iu,1) = 5.d0
      rcodcl(face,iv,1) = 0.d0
      rcodcl(face,iw,1) = 0.d0
    endif
  enddo
enddo
deallocate(list)

! Air (the first oxidiser) at the temperature of the gas in the duct, by velocity rather than by flow rate
ientat(1) = 1
iqimp(1)  = 0
inmoxy(1) = 1
timpat(1) = t0
icalke(1) = 2
dh(1)     = 0.04d0
xintur(1) = 0.05d0

end subroutine cs_f_user_boundary_conditions
