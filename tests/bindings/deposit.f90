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
  type(nw_wall_cooling) :: cooling, uncooled
  type(nw_wall_heat) :: heat
  type(nw_deposit_surroundings) :: around
  type(nw_deposit_losses) :: losses
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
  call must(nw_wall_cooling_init(uncooled))
  call must(nw_wall_cooling_init(cooling))
  cooling%coolant_temperature = 600
  cooling%coolant_coefficient = 2000
  cooling%wall_resistance = 1d-3
  cooling%gas_coefficient = 300
  cooling%emissivity = 0.8d0
  cooling%irradiation = 4d5
  call must(nw_wall_heat_init(heat))
  call must(nw_deposit_losses_init(losses))
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
      cooling%gas_temperature = merge(4000.0d0, 1500.0d0, modulo(impact%key, 64_c_int64_t) == 63)
      call must(nw_deposit_heat(model, deposit, 0.4d0, cooling, heat))
    end if
    call must(nw_deposit_surroundings_init(around))
    around%voidage = 0.4d0
    around%gas_density = 0.25d0
    around%kinematic_viscosity = 2.5d-4
    if (modulo(impact%key, 4_c_int64_t) == 3) then
      around%gravity_along = 9.81d0
      around%shear_down = 0.5d0
      around%shear_across = 0.25d0
      around%draw = 0.5d0
    else
      around%shear_down = 0.25d0*(0.25d0*real(1 + modulo(impact%key, 5_c_int64_t), c_double))**2
    end if
    if (modulo(impact%key, 4_c_int64_t) == 3) then
      call must(nw_deposit_advance(model, around, cooling, 1.0d0, deposit, losses))
    else
      call must(nw_deposit_advance(model, around, uncooled, 1.0d0, deposit, losses))
    end if
    if (modulo(impact%key, 4_c_int64_t) == 3 .and. deposit%molten + deposit%frozen + deposit%powder <= 0) &
      call must(nw_deposit_initial(model, 0.4d0, deposit))
    call must(nw_film_velocity(model, deposit, impact%T_w, 9.81d0, velocity))
    print '(i0, *(1x, es24.16e3))', outcome%stuck, impact%layer_thickness, impact%coverage, impact%melt_thickness, &
      deposit%molten, deposit%powder, deposit%solid, deposit%cover, deposit%conversion, velocity, &
      deposit%frozen, deposit%behind, deposit%closed, deposit%resuspended, heat%surface_temperature, &
      heat%wall_temperature, heat%heat_flux, heat%coolant_flux, heat%deposit_resistance, losses%mass
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
