! tests/bindings/deposit.c, in Fortran.
program deposit_test
  use nearwall
  use, intrinsic :: iso_fortran_env, only: iostat_end
  implicit none
  type(c_ptr) :: model
  type(nw_impact) :: impact
  type(nw_outcome) :: outcome
  type(nw_deposit) :: deposit
  type(nw_deposit_source) :: source
  real(c_double) :: velocity
  character(len=1024) :: path
  character(len=512) :: message
  integer :: unit, ended

  call get_command_argument(1, path)
  call must(nearwall_load(path, model, message))
  call must(nw_impact_init(impact))
  call must(nw_outcome_init(outcome))
  call must(nw_deposit_source_init(source))
  call must(nw_deposit_init(deposit))
  call must(nearwall_find_wall(model, 'default', deposit%wall))
  call must(nw_deposit_initial(model, 0.4d0, deposit))
  impact%wall = deposit%wall
  impact%seed = 1
  call get_command_argument(2, path)
  open (newunit=unit, file=path, status='old', action='read')
  read (unit, *)
  do
    read (unit, *, iostat=ended) impact%v_n, impact%v_t, impact%d, impact%T_p, impact%T_w
    if (ended == iostat_end) exit
    impact%conversion = merge(0.5d0, 1.0d0, modulo(impact%key, 2_c_int64_t) == 1)
    call must(nw_deposit_apply(model, deposit, 0.4d0, impact))
    call must(nw_resolve(model, impact, outcome))
    if (outcome%stuck == 1) call must(nw_deposit_source_add(model, impact, &
      real(1 + modulo(impact%key, 7_c_int64_t), c_double)/1024, 2300.0d0, source))
    if (modulo(impact%key, 4_c_int64_t) == 3) then
      call must(nw_deposit_add(source, deposit))
      call must(nw_deposit_source_init(source))
    end if
    call must(nw_film_velocity(model, deposit, impact%T_w, 9.81d0, velocity))
    print '(i0, 9(1x, es24.16e3))', outcome%stuck, impact%layer_thickness, impact%coverage, impact%melt_thickness, &
      deposit%molten, deposit%powder, deposit%solid, deposit%cover, deposit%conversion, velocity
    impact%key = impact%key + 1
  end do
  close (unit)
  call nw_model_free(model)

contains

  subroutine must(status)
    integer(c_int32_t), intent(in) :: status
    if (status == NW_OK) return
    print '(a)', nearwall_text(nw_status_text(status))
    stop 1
  end subroutine must
end program deposit_test
