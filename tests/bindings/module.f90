! nearwall.f90: every function of the library is called; arrays against single impacts, mass kept, faults with their words.
program module_test
  use nearwall
  implicit none
  integer, parameter :: count = 1000
  type(c_ptr) :: model, copy
  type(nw_impact) :: impact
  type(nw_outcome) :: outcome
  type(nw_impacts) :: impacts
  type(nw_outcomes) :: outcomes
  type(nw_deposit) :: deposit
  type(nw_deposit_source) :: source
  real(c_double), target :: v_n(count), v_t(count), e_n(count), e_t(count)
  integer(c_int32_t), target :: stuck(count), regime(count)
  integer(c_int64_t), target :: key(count)
  integer(c_size_t) :: first_bad
  integer(c_int32_t) :: status, wall, number
  real(c_double) :: adhesive, yielding, sticking, low, high, wall_low, wall_high, velocity
  character(len=512) :: message
  character(len=1024) :: path
  character(kind=c_char) :: room(512)
  character(len=*), parameter :: broken = 'x = = 1', nl = new_line('a')
  character(len=:), allocatable :: declared
  integer :: i

  call get_command_argument(1, path)
  status = nearwall_load('/nowhere/nearWall.toml', model, message)
  call must(status == NW_FILE, 'a file that is not there')
  call must(index(message, '/nowhere/nearWall.toml') > 0 .and. .not. c_associated(model), 'its message')
  copy = c_null_ptr
  status = nw_model_parse(broken, len(broken, c_size_t), 'mine'//c_null_char, copy, room, size(room, kind=c_size_t))
  call must(status == NW_MODEL, 'a broken text')
  call must(room(1) == 'm' .and. room(4) == 'e' .and. .not. c_associated(copy), 'its message')
  status = nearwall_load(path, model, message)
  call must(status == NW_OK, 'the model: '//trim(message))
  status = nearwall_find_wall(model, 'roof', wall)
  call must(status == NW_UNKNOWN_WALL, 'a wall that is not there')
  status = nearwall_find_wall(model, 'default', wall)
  call must(status == NW_OK .and. wall == 0, 'the wall')
  call must(nearwall_text(nw_regime_name(NW_SP_NSW)) == 'SP-NSW', 'the name of a regime')
  call must(nearwall_text(nw_status_text(NW_OK)) == 'success', 'the words of a status')
  call must(index(nearwall_text(nw_version()), '.') > 0, 'the version')

  ! Sizes: the library fills in its own.
  status = nw_impact_init(impact)
  call must(status == NW_OK .and. impact%struct_size == c_sizeof(impact), 'the size of an impact')
  status = nw_outcome_init(outcome)
  call must(status == NW_OK .and. outcome%struct_size == c_sizeof(outcome), 'the size of an outcome')
  status = nw_deposit_init(deposit)
  call must(status == NW_OK .and. deposit%struct_size == c_sizeof(deposit), 'the size of a deposit')
  status = nw_deposit_source_init(source)
  call must(status == NW_OK .and. source%struct_size == c_sizeof(source), 'the size of source')
  call must(impacts%struct_size == c_sizeof(impacts) .and. outcomes%struct_size == c_sizeof(outcomes), 'the sizes of arrays')

  ! Inputs that a model file declares: e_n = 0.5 + 0.2 humidity.
  declared = '[particle]'//nl//'material = "montan-wax"'//nl//'[walls.default]'//nl//'material = "pyrex"'//nl// &
    '[normal]'//nl//'model = "constant"'//nl//'e_n = 0.5'//nl//'[tangential]'//nl//'model = "constant"'//nl// &
    'e_t = 0.76'//nl//'[inputs.humidity]'//nl//'default = 0.4'//nl//'[[effects]]'//nl//'kind = "fitted-curve"'//nl// &
    'input = "humidity"'//nl//'on = "e_n"'//nl//'knots = [0, 1]'//nl//'values = [0, 0.2]'//nl
  status = nw_model_parse(declared, len(declared, c_size_t), 'mine'//c_null_char, copy, room, size(room, kind=c_size_t))
  call must(status == NW_OK, 'a model with an input of its own')
  status = nw_extra_input_count(copy, number)
  call must(status == NW_OK .and. number == 1, 'the number of its inputs')
  status = nw_extra_input_name(copy, 0_c_int32_t, room, size(room, kind=c_size_t))
  call must(status == NW_OK .and. room(1) == 'h' .and. room(9) == c_null_char, 'the name of its input')
  call must(nw_extra_input_default(copy, 1_c_int32_t, low) == NW_UNKNOWN_INPUT, 'an input that is not declared')
  status = nw_extra_input_default(copy, 0_c_int32_t, low)
  call must(status == NW_OK .and. abs(low - 0.4d0) < 1d-15, 'its default')
  call must(nw_extra_input_word(copy, 0_c_int32_t, 0_c_int32_t, room, size(room, kind=c_size_t)) == NW_UNKNOWN_INPUT, &
    'a number has no words')
  status = nw_extra_input_value(copy, 0_c_int32_t, '0.9'//c_null_char, high, room, size(room, kind=c_size_t))
  call must(status == NW_OK .and. abs(high - 0.9d0) < 1d-15, 'its value of a text')
  impact%v_n = 2.0d0
  status = nw_resolve(copy, impact, outcome)
  call must(status == NW_OK .and. abs(outcome%e_n - 0.58d0) < 1d-15, 'e_n at the default')
  impact%extra(1) = high
  status = nw_resolve(copy, impact, outcome)
  call must(status == NW_OK .and. abs(outcome%e_n - 0.68d0) < 1d-15, 'e_n at a value')
  call nw_model_free(copy)
  status = nw_impact_init(impact)

  ! Arrays and single impacts: the same bits.
  do i = 1, count
    v_n(i) = 10.0d0**(-2.0d0 + 3.3d0*i/count)
    v_t(i) = modulo(0.37d0*i, 5.0d0)
    key(i) = 7*i
  end do
  impacts%count = count
  impacts%seed = 3
  impacts%v_n = c_loc(v_n)
  impacts%v_t = c_loc(v_t)
  impacts%key = c_loc(key)
  outcomes%e_n = c_loc(e_n)
  outcomes%e_t = c_loc(e_t)
  outcomes%stuck = c_loc(stuck)
  outcomes%regime = c_loc(regime)
  first_bad = -1
  status = nw_resolve_batch(model, impacts, outcomes, first_bad)
  call must(status == NW_OK .and. first_bad == -1, 'the arrays')
  do i = 1, count
    impact%seed = 3
    impact%v_n = v_n(i)
    impact%v_t = v_t(i)
    impact%key = key(i)
    status = nw_resolve(model, impact, outcome)
    call must(status == NW_OK, 'an impact')
    call must(same(e_n(i), outcome%e_n) .and. same(e_t(i), outcome%e_t), 'the bits of an impact')
    call must(stuck(i) == outcome%stuck .and. regime(i) == outcome%regime, 'the capture of an impact')
  end do
  call must(any(stuck == 1) .and. any(stuck == 0), 'some stay, some leave')
  v_n(18) = -1.0d0
  status = nw_resolve_batch(model, impacts, outcomes, first_bad)
  call must(status == NW_BAD_STATE .and. first_bad == 17, 'the impact at fault')

  ! The sticking velocity is where particles begin to leave; a range is a range.
  status = nw_speeds(model, impact, adhesive, yielding, sticking)
  call must(status == NW_OK, 'the speeds')
  impact%v_n = 0.999d0*sticking
  status = nw_resolve(model, impact, outcome)
  call must(status == NW_OK .and. outcome%stuck == 1, 'slower than the sticking velocity')
  impact%v_n = 1.001d0*sticking
  status = nw_resolve(model, impact, outcome)
  call must(status == NW_OK .and. outcome%stuck == 0, 'faster than the sticking velocity')
  status = nw_temperature_ranges(model, wall, low, high, wall_low, wall_high)
  call must(status == NW_OK, 'the temperatures')
  call must(low < high .and. wall_low < wall_high, 'the order of temperatures')

  ! What arrives is powder on a cold wall and melt on a hot one, and its mass lies in the deposit.
  status = nw_deposit_initial(model, 0.4d0, deposit)
  call must(status == NW_OK, 'where a deposit begins')
  status = nw_deposit_source_add(model, impact, 0.25d0, 2500.0d0, source)
  call must(status == NW_OK, 'a cold particle')
  impact%T_p = 1700.0d0
  impact%T_w = 1700.0d0
  status = nw_deposit_source_add(model, impact, 0.5d0, 2500.0d0, source)
  call must(status == NW_OK .and. source%count == 2, 'a hot particle')
  call must(same(source%powder, 0.25d0) .and. same(source%molten, 0.5d0), 'powder and melt')
  call must(same(source%solid, 0.25d0/2500.0d0), 'the volume of the powder')
  status = nw_deposit_add(source, deposit)
  call must(status == NW_OK, 'the deposit')
  call must(abs(deposit%molten + deposit%powder - 0.75d0) < 1.0d-15, 'mass is kept')
  status = nw_deposit_apply(model, deposit, 0.4d0, impact)
  call must(status == NW_OK .and. impact%melt_thickness > 0, 'the melt that is met')
  status = nw_film_velocity(model, deposit, 1700.0d0, 9.81d0, velocity)
  call must(status == NW_OK .and. velocity > 0, 'the film runs')
  adhesive = velocity
  status = nw_film_velocity(model, deposit, 1700.0d0, 2*9.81d0, velocity)
  call must(status == NW_OK, 'twice the gravity')
  call must(abs(velocity/adhesive - 2) < 1.0d-14, 'twice the speed')
  call nw_model_free(model)
  print '(a)', 'every function called'

contains

  pure logical function same(one, other)
    real(c_double), intent(in) :: one, other
    same = transfer(one, 0_c_int64_t) == transfer(other, 0_c_int64_t)
  end function same

  subroutine must(good, what)
    logical, intent(in) :: good
    character(len=*), intent(in) :: what
    if (good) return
    print '(2a)', 'wrong: ', what
    stop 1
  end subroutine must
end program module_test
