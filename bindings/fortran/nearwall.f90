! What happens when a particle hits a wall: the C interface of libnearwall for Fortran 2003 and later.
!
! Types and functions have the names, order and units of nearwall.h, which describes them. A model is a type(c_ptr).
! nw_impacts and nw_outcomes begin without arrays; set theirs with c_loc of a contiguous target. nearwall_load,
! nearwall_find_wall and nearwall_text use Fortran strings. Indices such as first_bad count from 0, as in C.
! NEARWALL_ABI_VERSION is NW_ABI_VERSION of nearwall.h: Fortran does not distinguish that name from the function's.
!
!     use nearwall
!     type(c_ptr) :: model
!     type(nw_impact) :: impact
!     type(nw_outcome) :: outcome
!     character(len=512) :: message
!     status = nearwall_load('nearWall.toml', model, message)
!     status = nw_impact_init(impact)
!     status = nw_outcome_init(outcome)
!     impact%v_n = 2.0d0
!     status = nw_resolve(model, impact, outcome)
!
! Fortran has no unsigned integers: seed and key are the same 64 bits, whatever sign Fortran sees in them.
! Licence: MIT OR Apache-2.0.
module nearwall
  use, intrinsic :: iso_c_binding
  implicit none
  public

  ! GENERATED from nearwall.h: `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.
  integer(c_int32_t), parameter :: NEARWALL_ABI_VERSION = 1
  integer(c_int32_t), parameter :: NW_EXTRA_INPUTS = 8
  integer(c_int32_t), parameter :: NW_PROCESSES = 5
  integer(c_int32_t), parameter :: NW_DIRECTIONS = 3
  integer(c_int32_t), parameter :: NW_OUTSIDE_VALID_RANGE = 1
  integer(c_int32_t), parameter :: NW_OK = 0
  integer(c_int32_t), parameter :: NW_NULL_POINTER = 1
  integer(c_int32_t), parameter :: NW_STRUCT_SIZE = 2
  integer(c_int32_t), parameter :: NW_NOT_UTF8 = 3
  integer(c_int32_t), parameter :: NW_FILE = 4
  integer(c_int32_t), parameter :: NW_MODEL = 5
  integer(c_int32_t), parameter :: NW_UNKNOWN_WALL = 6
  integer(c_int32_t), parameter :: NW_BAD_STATE = 7
  integer(c_int32_t), parameter :: NW_OUT_OF_RANGE = 8
  integer(c_int32_t), parameter :: NW_PANIC = 9
  integer(c_int32_t), parameter :: NW_UNKNOWN_INPUT = 10
  integer(c_int32_t), parameter :: NW_NO_CONDUCTIVITY = 11
  integer(c_int32_t), parameter :: NW_NO_HEAT_CAPACITY = 12
  integer(c_int32_t), parameter :: NW_NSP_NSW = 0
  integer(c_int32_t), parameter :: NW_NSP_SW = 1
  integer(c_int32_t), parameter :: NW_SP_NSW = 2
  integer(c_int32_t), parameter :: NW_SP_SW = 3

  type, bind(c) :: nw_impact
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: wall
    integer(c_int64_t) :: seed
    integer(c_int64_t) :: key
    real(c_double) :: v_n
    real(c_double) :: v_t
    real(c_double) :: omega
    real(c_double) :: d
    real(c_double) :: T_p
    real(c_double) :: rho_p
    real(c_double) :: conversion
    real(c_double) :: T_w
    real(c_double) :: T_under
    real(c_double) :: roughness
    real(c_double) :: coverage
    real(c_double) :: layer_thickness
    real(c_double) :: film_thickness
    real(c_double) :: melt_thickness
    real(c_double) :: v_gas
    real(c_double) :: extra(NW_EXTRA_INPUTS)
  end type nw_impact

  type, bind(c) :: nw_outcome
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: regime
    integer(c_int32_t) :: stuck
    integer(c_int32_t) :: flags
    real(c_double) :: e_n
    real(c_double) :: e_t
    real(c_double) :: p_stick
    real(c_double) :: omega
  end type nw_outcome

  type, bind(c) :: nw_impacts
    integer(c_int32_t) :: struct_size = 224
    integer(c_int32_t) :: wall = 0
    integer(c_size_t) :: count = 0
    integer(c_int64_t) :: seed = 0
    type(c_ptr) :: walls = c_null_ptr
    type(c_ptr) :: key = c_null_ptr
    type(c_ptr) :: v_n = c_null_ptr
    type(c_ptr) :: v_t = c_null_ptr
    type(c_ptr) :: omega = c_null_ptr
    type(c_ptr) :: d = c_null_ptr
    type(c_ptr) :: T_p = c_null_ptr
    type(c_ptr) :: rho_p = c_null_ptr
    type(c_ptr) :: conversion = c_null_ptr
    type(c_ptr) :: T_w = c_null_ptr
    type(c_ptr) :: T_under = c_null_ptr
    type(c_ptr) :: roughness = c_null_ptr
    type(c_ptr) :: coverage = c_null_ptr
    type(c_ptr) :: layer_thickness = c_null_ptr
    type(c_ptr) :: film_thickness = c_null_ptr
    type(c_ptr) :: melt_thickness = c_null_ptr
    type(c_ptr) :: v_gas = c_null_ptr
    type(c_ptr) :: extra(NW_EXTRA_INPUTS) = c_null_ptr
  end type nw_impacts

  type, bind(c) :: nw_outcomes
    integer(c_int32_t) :: struct_size = 64
    type(c_ptr) :: e_n = c_null_ptr
    type(c_ptr) :: e_t = c_null_ptr
    type(c_ptr) :: p_stick = c_null_ptr
    type(c_ptr) :: omega = c_null_ptr
    type(c_ptr) :: regime = c_null_ptr
    type(c_ptr) :: stuck = c_null_ptr
    type(c_ptr) :: flags = c_null_ptr
  end type nw_outcomes

  type, bind(c) :: nw_wall_cooling
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: reserved
    real(c_double) :: coolant_temperature
    real(c_double) :: coolant_coefficient
    real(c_double) :: wall_resistance
    real(c_double) :: gas_temperature
    real(c_double) :: gas_coefficient
    real(c_double) :: emissivity
    real(c_double) :: irradiation
    real(c_double) :: further_flux
    real(c_double) :: gas_conductivity
    real(c_double) :: void_temperature
    real(c_double) :: other_conductivity
    real(c_double) :: other_temperature
    real(c_double) :: vapour_fraction
    real(c_double) :: vapour_coefficient
  end type nw_wall_cooling

  type, bind(c) :: nw_wall_heat
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: reserved
    real(c_double) :: surface_temperature
    real(c_double) :: wall_temperature
    real(c_double) :: heat_flux
    real(c_double) :: coolant_flux
    real(c_double) :: deposit_resistance
    real(c_double) :: disagreement
    real(c_double) :: behind_temperature
    real(c_double) :: behind_resistance
  end type nw_wall_heat

  type, bind(c) :: nw_deposit
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: wall
    real(c_double) :: molten
    real(c_double) :: powder
    real(c_double) :: solid
    real(c_double) :: cover
    real(c_double) :: conversion
    real(c_double) :: closed
    real(c_double) :: resuspended
    real(c_double) :: frozen
    real(c_double) :: behind
  end type nw_deposit

  type, bind(c) :: nw_deposit_source
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: count
    real(c_double) :: molten
    real(c_double) :: powder
    real(c_double) :: solid
    real(c_double) :: cover
    real(c_double) :: buried
    real(c_double) :: converted
  end type nw_deposit_source

  type, bind(c) :: nw_deposit_surroundings
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: reserved
    real(c_double) :: voidage
    real(c_double) :: wall_temperature
    real(c_double) :: gas_density
    real(c_double) :: kinematic_viscosity
    real(c_double) :: shear_down
    real(c_double) :: shear_across
    real(c_double) :: gravity_outward
    real(c_double) :: gravity_along
    real(c_double) :: draw
  end type nw_deposit_surroundings

  type, bind(c) :: nw_deposit_losses
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: reserved
    real(c_double) :: mass(NW_PROCESSES)
    real(c_double) :: heat_taken
    real(c_double) :: heat_to_coolant
    real(c_double) :: heat_of_fusion
    real(c_double) :: heat_released
    real(c_double) :: deposit_resistance
  end type nw_deposit_losses

  type, bind(c) :: nw_walk
    integer(c_int32_t) :: struct_size
    integer(c_int32_t) :: reserved
    integer(c_int64_t) :: seed
    integer(c_int64_t) :: key
    integer(c_int64_t) :: step
    real(c_double) :: duration
    real(c_double) :: relaxation_time
    real(c_double) :: friction_velocity
    real(c_double) :: kinematic_viscosity
    real(c_double) :: wall_distance
    real(c_double) :: normal(NW_DIRECTIONS)
    real(c_double) :: flow(NW_DIRECTIONS)
    real(c_double) :: core_fluctuation
    real(c_double) :: core_time
    real(c_double) :: core_gradient(NW_DIRECTIONS)
    real(c_double) :: values(NW_DIRECTIONS)
    real(c_double) :: velocity(NW_DIRECTIONS)
    real(c_double) :: longest_step
  end type nw_walk

  interface
    function nw_abi_version() bind(c)
      import
      integer(c_int32_t) :: nw_abi_version
    end function nw_abi_version

    function nw_version() bind(c)
      import
      type(c_ptr) :: nw_version
    end function nw_version

    function nw_status_text(status) bind(c)
      import
      integer(c_int32_t), value :: status
      type(c_ptr) :: nw_status_text
    end function nw_status_text

    function nw_regime_name(regime) bind(c)
      import
      integer(c_int32_t), value :: regime
      type(c_ptr) :: nw_regime_name
    end function nw_regime_name

    function nw_model_load(path, model, message, message_size) bind(c)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: model
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_size_t), value :: message_size
      integer(c_int32_t) :: nw_model_load
    end function nw_model_load

    function nw_model_parse(toml, toml_size, name, model, message, message_size) bind(c)
      import
      character(kind=c_char), intent(in) :: toml(*)
      integer(c_size_t), value :: toml_size
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(inout) :: model
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_size_t), value :: message_size
      integer(c_int32_t) :: nw_model_parse
    end function nw_model_parse

    subroutine nw_model_free(model) bind(c)
      import
      type(c_ptr), value :: model
    end subroutine nw_model_free

    function nw_model_find_wall(model, name, wall) bind(c)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(inout) :: wall
      integer(c_int32_t) :: nw_model_find_wall
    end function nw_model_find_wall

    function nw_impact_init(impact) bind(c)
      import
      type(nw_impact), intent(inout) :: impact
      integer(c_int32_t) :: nw_impact_init
    end function nw_impact_init

    function nw_outcome_init(outcome) bind(c)
      import
      type(nw_outcome), intent(inout) :: outcome
      integer(c_int32_t) :: nw_outcome_init
    end function nw_outcome_init

    function nw_resolve(model, impact, outcome) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      type(nw_outcome), intent(inout) :: outcome
      integer(c_int32_t) :: nw_resolve
    end function nw_resolve

    function nw_explain(model, impact, message, message_size) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_size_t), value :: message_size
      integer(c_int32_t) :: nw_explain
    end function nw_explain

    function nw_beyond(model, impact, text, text_size) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_size_t), value :: text_size
      integer(c_int32_t) :: nw_beyond
    end function nw_beyond

    function nw_unlikely(impact, text, text_size) bind(c)
      import
      type(nw_impact), intent(in) :: impact
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_size_t), value :: text_size
      integer(c_int32_t) :: nw_unlikely
    end function nw_unlikely

    function nw_key_of_values(values, count, key) bind(c)
      import
      real(c_double), intent(in) :: values
      integer(c_size_t), value :: count
      integer(c_int64_t), intent(inout) :: key
      integer(c_int32_t) :: nw_key_of_values
    end function nw_key_of_values

    function nw_speeds(model, impact, adhesive, yielding, sticking) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), intent(inout) :: adhesive
      real(c_double), intent(inout) :: yielding
      real(c_double), intent(inout) :: sticking
      integer(c_int32_t) :: nw_speeds
    end function nw_speeds

    function nw_particle_density(model, impact, density) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), intent(inout) :: density
      integer(c_int32_t) :: nw_particle_density
    end function nw_particle_density

    function nw_erosion(model, impact, mass, volume) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), value :: mass
      real(c_double), intent(inout) :: volume
      integer(c_int32_t) :: nw_erosion
    end function nw_erosion

    function nw_temperature_ranges(model, wall, particle_low, particle_high, wall_low, wall_high) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: wall
      real(c_double), intent(inout) :: particle_low
      real(c_double), intent(inout) :: particle_high
      real(c_double), intent(inout) :: wall_low
      real(c_double), intent(inout) :: wall_high
      integer(c_int32_t) :: nw_temperature_ranges
    end function nw_temperature_ranges

    function nw_resolve_batch(model, impacts, outcomes, first_bad) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impacts), intent(in) :: impacts
      type(nw_outcomes), intent(in) :: outcomes
      integer(c_size_t), intent(inout) :: first_bad
      integer(c_int32_t) :: nw_resolve_batch
    end function nw_resolve_batch

    function nw_wall_cooling_init(cooling) bind(c)
      import
      type(nw_wall_cooling), intent(inout) :: cooling
      integer(c_int32_t) :: nw_wall_cooling_init
    end function nw_wall_cooling_init

    function nw_wall_heat_init(heat) bind(c)
      import
      type(nw_wall_heat), intent(inout) :: heat
      integer(c_int32_t) :: nw_wall_heat_init
    end function nw_wall_heat_init

    function nw_deposit_heat(model, deposit, voidage, cooling, heat) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_deposit), intent(in) :: deposit
      real(c_double), value :: voidage
      type(nw_wall_cooling), intent(in) :: cooling
      type(nw_wall_heat), intent(inout) :: heat
      integer(c_int32_t) :: nw_deposit_heat
    end function nw_deposit_heat

    function nw_contact_heat(model, impact, heat) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), intent(inout) :: heat
      integer(c_int32_t) :: nw_contact_heat
    end function nw_contact_heat

    function nw_heat_brought(model, impact, heat_capacity, heat) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), value :: heat_capacity
      real(c_double), intent(inout) :: heat
      integer(c_int32_t) :: nw_heat_brought
    end function nw_heat_brought

    function nw_deposit_init(deposit) bind(c)
      import
      type(nw_deposit), intent(inout) :: deposit
      integer(c_int32_t) :: nw_deposit_init
    end function nw_deposit_init

    function nw_deposit_initial(model, voidage, deposit) bind(c)
      import
      type(c_ptr), value :: model
      real(c_double), value :: voidage
      type(nw_deposit), intent(inout) :: deposit
      integer(c_int32_t) :: nw_deposit_initial
    end function nw_deposit_initial

    function nw_deposit_source_init(source) bind(c)
      import
      type(nw_deposit_source), intent(inout) :: source
      integer(c_int32_t) :: nw_deposit_source_init
    end function nw_deposit_source_init

    function nw_deposit_source_add(model, impact, mass, density, source) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), value :: mass
      real(c_double), value :: density
      type(nw_deposit_source), intent(inout) :: source
      integer(c_int32_t) :: nw_deposit_source_add
    end function nw_deposit_source_add

    function nw_deposit_add(source, deposit) bind(c)
      import
      type(nw_deposit_source), intent(in) :: source
      type(nw_deposit), intent(inout) :: deposit
      integer(c_int32_t) :: nw_deposit_add
    end function nw_deposit_add

    function nw_deposit_apply(model, deposit, voidage, impact) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_deposit), intent(in) :: deposit
      real(c_double), value :: voidage
      type(nw_impact), intent(inout) :: impact
      integer(c_int32_t) :: nw_deposit_apply
    end function nw_deposit_apply

    function nw_film_velocity(model, deposit, T_w, gravity_along, velocity) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_deposit), intent(in) :: deposit
      real(c_double), value :: T_w
      real(c_double), value :: gravity_along
      real(c_double), intent(inout) :: velocity
      integer(c_int32_t) :: nw_film_velocity
    end function nw_film_velocity

    function nw_cooled_film_velocity(model, deposit, T_surface, heat_flux, gravity_along, velocity) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_deposit), intent(in) :: deposit
      real(c_double), value :: T_surface
      real(c_double), value :: heat_flux
      real(c_double), value :: gravity_along
      real(c_double), intent(inout) :: velocity
      integer(c_int32_t) :: nw_cooled_film_velocity
    end function nw_cooled_film_velocity

    function nw_extra_input_count(model, count) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), intent(inout) :: count
      integer(c_int32_t) :: nw_extra_input_count
    end function nw_extra_input_count

    function nw_extra_input_name(model, index, name, name_size) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: index
      character(kind=c_char), intent(inout) :: name(*)
      integer(c_size_t), value :: name_size
      integer(c_int32_t) :: nw_extra_input_name
    end function nw_extra_input_name

    function nw_extra_input_default(model, index, value) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: index
      real(c_double), intent(inout) :: value
      integer(c_int32_t) :: nw_extra_input_default
    end function nw_extra_input_default

    function nw_extra_input_word(model, index, word, text, text_size) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: index
      integer(c_int32_t), value :: word
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_size_t), value :: text_size
      integer(c_int32_t) :: nw_extra_input_word
    end function nw_extra_input_word

    function nw_extra_input_value(model, index, text, value, message, message_size) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: index
      character(kind=c_char), intent(in) :: text(*)
      real(c_double), intent(inout) :: value
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_size_t), value :: message_size
      integer(c_int32_t) :: nw_extra_input_value
    end function nw_extra_input_value

    function nw_deposit_surroundings_init(surroundings) bind(c)
      import
      type(nw_deposit_surroundings), intent(inout) :: surroundings
      integer(c_int32_t) :: nw_deposit_surroundings_init
    end function nw_deposit_surroundings_init

    function nw_deposit_losses_init(losses) bind(c)
      import
      type(nw_deposit_losses), intent(inout) :: losses
      integer(c_int32_t) :: nw_deposit_losses_init
    end function nw_deposit_losses_init

    function nw_deposit_advance(model, surroundings, cooling, duration, deposit, losses) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_deposit_surroundings), intent(in) :: surroundings
      type(nw_wall_cooling), intent(in) :: cooling
      real(c_double), value :: duration
      type(nw_deposit), intent(inout) :: deposit
      type(nw_deposit_losses), intent(inout) :: losses
      integer(c_int32_t) :: nw_deposit_advance
    end function nw_deposit_advance

    function nw_wall_processes(model, wall, processes) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: wall
      integer(c_int32_t), intent(inout) :: processes
      integer(c_int32_t) :: nw_wall_processes
    end function nw_wall_processes

    function nw_process_name(process) bind(c)
      import
      integer(c_int32_t), value :: process
      type(c_ptr) :: nw_process_name
    end function nw_process_name

    function nw_process_loss(process) bind(c)
      import
      integer(c_int32_t), value :: process
      type(c_ptr) :: nw_process_loss
    end function nw_process_loss

    function nw_process_gain(process) bind(c)
      import
      integer(c_int32_t), value :: process
      type(c_ptr) :: nw_process_gain
    end function nw_process_gain

    function nw_walk_init(walk) bind(c)
      import
      type(nw_walk), intent(inout) :: walk
      integer(c_int32_t) :: nw_walk_init
    end function nw_walk_init

    function nw_walk_advance(walk) bind(c)
      import
      type(nw_walk), intent(inout) :: walk
      integer(c_int32_t) :: nw_walk_advance
    end function nw_walk_advance

    function nw_thermophoresis( &
        temperature, density, viscosity, conductivity, mean_free_path, diameter, particle_conductivity, &
        force) bind(c)
      import
      real(c_double), value :: temperature
      real(c_double), value :: density
      real(c_double), value :: viscosity
      real(c_double), value :: conductivity
      real(c_double), value :: mean_free_path
      real(c_double), value :: diameter
      real(c_double), value :: particle_conductivity
      real(c_double), intent(inout) :: force
      integer(c_int32_t) :: nw_thermophoresis
    end function nw_thermophoresis

  end interface
  ! END GENERATED

contains

  ! Loads a model file; trailing blanks of the path are ignored. On failure message has the reason.
  function nearwall_load(path, model, message) result(status)
    character(len=*), intent(in) :: path
    type(c_ptr), intent(inout) :: model
    character(len=*), intent(inout) :: message
    integer(c_int32_t) :: status
    character(kind=c_char) :: room(len(message) + 1)
    integer :: i

    model = c_null_ptr
    message = ''
    room = c_null_char
    if (nw_abi_version() /= NEARWALL_ABI_VERSION) then
      message = 'libnearwall and the module nearwall have different interface versions'
      status = NW_STRUCT_SIZE
      return
    end if
    status = nw_model_load(trim(path)//c_null_char, model, room, size(room, kind=c_size_t))
    do i = 1, len(message)
      if (room(i) == c_null_char) exit
      message(i:i) = room(i)
    end do
  end function nearwall_load

  ! Finds the wall of a patch.
  function nearwall_find_wall(model, name, wall) result(status)
    type(c_ptr), intent(in) :: model
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(inout) :: wall
    integer(c_int32_t) :: status

    status = nw_model_find_wall(model, trim(name)//c_null_char, wall)
  end function nearwall_find_wall

  ! Converts a string of the library: nearwall_text(nw_status_text(status)), nearwall_text(nw_version()).
  function nearwall_text(static_text) result(text)
    type(c_ptr), intent(in) :: static_text
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i

    text = ''
    call c_f_pointer(static_text, letters, [1024]) ! every string is shorter
    do i = 1, size(letters)
      if (letters(i) == c_null_char) exit
      text = text//letters(i)
    end do
  end function nearwall_text
end module nearwall
