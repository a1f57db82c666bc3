! Resolves the impacts of a file, one at a time, in Fortran 2008.
!
!     gfortran $(pkg-config --variable=fortran_module nearwall) example.f90 $(pkg-config --libs nearwall) -o example
!     ./example nearWall.toml impacts.csv
!
! The table has the columns v_n,v_t,d,T_p,T_w (SI units) and one header line; more pairs of model and table may follow.
! Prints e_n, e_t, the capture probability and 1 (captured) or 0 for each impact.
program example
  use nearwall
  use, intrinsic :: iso_fortran_env, only: error_unit, iostat_end
  implicit none
  character(len=1024) :: model_file, table_file
  integer :: i

  do i = 1, command_argument_count() - 1, 2
    call get_command_argument(i, model_file)
    call get_command_argument(i + 1, table_file)
    call decide(trim(model_file), trim(table_file))
  end do

contains

  subroutine decide(model_file, table_file)
    character(len=*), intent(in) :: model_file, table_file
    type(c_ptr) :: model
    type(nw_impact) :: impact
    type(nw_outcome) :: outcome
    character(len=512) :: message
    integer :: unit, ended

    if (nearwall_load(model_file, model, message) /= NW_OK) then
      write (error_unit, '(a)') trim(message)
      stop 1
    end if
    call check(nw_impact_init(impact))
    call check(nw_outcome_init(outcome))
    call check(nearwall_find_wall(model, 'default', impact%wall))
    impact%seed = 1

    open (newunit=unit, file=table_file, status='old', action='read')
    read (unit, *)
    do
      read (unit, *, iostat=ended) impact%v_n, impact%v_t, impact%d, impact%T_p, impact%T_w
      if (ended == iostat_end) exit
      if (ended /= 0) stop 1
      call check(nw_resolve(model, impact, outcome))
      print '(3(es24.16e3, 1x), i0)', outcome%e_n, outcome%e_t, outcome%p_stick, outcome%stuck
      impact%key = impact%key + 1 ! unique: random draws depend only on seed and key
    end do
    close (unit)
    call nw_model_free(model)
  end subroutine decide

  subroutine check(status)
    integer(c_int32_t), intent(in) :: status

    if (status == NW_OK) return
    write (error_unit, '(a)') nearwall_text(nw_status_text(status))
    stop 1
  end subroutine check
end program example
