! What the coal model wants to know of its gas.

subroutine cs_user_combustion

use ppincl
use ppthch
use ppcpfu
use cpincl
use coincl

implicit none

srrom  = 0.d0     ! no relaxation of the density
diftl0 = 4.25d-5  ! dynamic diffusion of enthalpy [kg/m/s]

end subroutine cs_user_combustion
