! What happens when a particle hits a wall: the C interface of libnearwall for Fortran 2003 and later.
!
! Types and functions are those of nearwall.h, which says what each does; names, order and units are the same. A model is
! a type(c_ptr). Pass arrays of nw_impacts and nw_outcomes with c_loc of a contiguous target; c_null_ptr is "not given".
! nearwall_load, nearwall_find_wall and nearwall_text take and give Fortran texts.
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

  ! NW_ABI_VERSION of nearwall.h: Fortran cannot tell that name from the function's
  integer(c_int32_t), parameter :: NEARWALL_ABI_VERSION = 1
  ! A status
  integer(c_int32_t), parameter :: NW_OK = 0, NW_NULL_POINTER = 1, NW_STRUCT_SIZE = 2, NW_NOT_UTF8 = 3, NW_FILE = 4
  integer(c_int32_t), parameter :: NW_MODEL = 5, NW_UNKNOWN_WALL = 6, NW_BAD_STATE = 7, NW_OUT_OF_RANGE = 8, NW_PANIC = 9
  ! A regime: sticky particle (SP) or not, sticky wall (SW) or not
  integer(c_int32_t), parameter :: NW_NSP_NSW = 0, NW_NSP_SW = 1, NW_SP_NSW = 2, NW_SP_SW = 3
  ! A bit of flags
  integer(c_int32_t), parameter :: NW_OUTSIDE_VALID_RANGE = 1

  type, bind(c) :: nw_impact
    integer(c_int32_t) :: struct_size, wall
    real(c_double) :: v_n, v_t, d, T_p, T_w, conversion, layer_thickness, film_thickness, v_gas, roughness, omega, coverage
    integer(c_int64_t) :: seed, key
    real(c_double) :: melt_thickness
  end type nw_impact

  type, bind(c) :: nw_outcome
    integer(c_int32_t) :: struct_size, regime, stuck, flags
    real(c_double) :: e_n, e_t, p_stick, omega
  end type nw_outcome

  ! Filled with nothing but its size: set count and v_n.
  type, bind(c) :: nw_impacts
    integer(c_int32_t) :: struct_size = 144, wall = 0
    integer(c_size_t) :: count = 0
    integer(c_int64_t) :: seed = 0
    type(c_ptr) :: walls = c_null_ptr
    type(c_ptr) :: v_n = c_null_ptr, v_t = c_null_ptr, d = c_null_ptr, T_p = c_null_ptr, T_w = c_null_ptr
    type(c_ptr) :: conversion = c_null_ptr, layer_thickness = c_null_ptr, film_thickness = c_null_ptr, v_gas = c_null_ptr
    type(c_ptr) :: roughness = c_null_ptr, omega = c_null_ptr, coverage = c_null_ptr
    type(c_ptr) :: key = c_null_ptr, melt_thickness = c_null_ptr
  end type nw_impacts

  ! Filled with nothing but its size: set the arrays that are wanted.
  type, bind(c) :: nw_outcomes
    integer(c_int32_t) :: struct_size = 64
    type(c_ptr) :: e_n = c_null_ptr, e_t = c_null_ptr, p_stick = c_null_ptr, omega = c_null_ptr
    type(c_ptr) :: regime = c_null_ptr, stuck = c_null_ptr, flags = c_null_ptr
  end type nw_outcomes

  type, bind(c) :: nw_deposit
    integer(c_int32_t) :: struct_size, wall
    real(c_double) :: molten, powder, solid, cover, conversion
  end type nw_deposit

  type, bind(c) :: nw_deposit_source
    integer(c_int32_t) :: struct_size, count
    real(c_double) :: molten, powder, solid, cover, buried, converted
  end type nw_deposit_source

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
      character(kind=c_char), intent(in) :: toml(*), name(*)
      integer(c_size_t), value :: toml_size
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

    function nw_speeds(model, impact, adhesive, yielding, sticking) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), intent(inout) :: adhesive, yielding, sticking
      integer(c_int32_t) :: nw_speeds
    end function nw_speeds

    function nw_temperature_ranges(model, wall, particle_low, particle_high, wall_low, wall_high) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: wall
      real(c_double), intent(inout) :: particle_low, particle_high, wall_low, wall_high
      integer(c_int32_t) :: nw_temperature_ranges
    end function nw_temperature_ranges

    ! first_bad counts from 0, as C does.
    function nw_resolve_batch(model, impacts, outcomes, first_bad) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impacts), intent(in) :: impacts
      type(nw_outcomes), intent(in) :: outcomes
      integer(c_size_t), intent(inout) :: first_bad
      integer(c_int32_t) :: nw_resolve_batch
    end function nw_resolve_batch

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

    function nw_deposit_source_init(arrivals) bind(c)
      import
      type(nw_deposit_source), intent(inout) :: arrivals
      integer(c_int32_t) :: nw_deposit_source_init
    end function nw_deposit_source_init

    function nw_deposit_source_add(model, impact, mass, density, arrivals) bind(c)
      import
      type(c_ptr), value :: model
      type(nw_impact), intent(in) :: impact
      real(c_double), value :: mass, density
      type(nw_deposit_source), intent(inout) :: arrivals
      integer(c_int32_t) :: nw_deposit_source_add
    end function nw_deposit_source_add

    function nw_deposit_add(arrivals, deposit) bind(c)
      import
      type(nw_deposit_source), intent(in) :: arrivals
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
      real(c_double), value :: T_w, gravity_along
      real(c_double), intent(inout) :: velocity
      integer(c_int32_t) :: nw_film_velocity
    end function nw_film_velocity
  end interface

contains

  ! Reads a model file; trailing blanks of the path do not count. On failure the reason is in message.
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
      message = 'libnearwall has another interface version than the module nearwall'
      status = NW_STRUCT_SIZE
      return
    end if
    status = nw_model_load(trim(path)//c_null_char, model, room, size(room, kind=c_size_t))
    do i = 1, len(message)
      if (room(i) == c_null_char) exit
      message(i:i) = room(i)
    end do
  end function nearwall_load

  ! The index of the wall that a patch name belongs to.
  function nearwall_find_wall(model, name, wall) result(status)
    type(c_ptr), intent(in) :: model
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(inout) :: wall
    integer(c_int32_t) :: status

    status = nw_model_find_wall(model, trim(name)//c_null_char, wall)
  end function nearwall_find_wall

  ! A text of the library: nearwall_text(nw_status_text(status)), nearwall_text(nw_version()).
  function nearwall_text(static_text) result(text)
    type(c_ptr), intent(in) :: static_text
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: i

    text = ''
    call c_f_pointer(static_text, letters, [1024]) ! all are shorter; nothing is read past the closing zero
    do i = 1, size(letters)
      if (letters(i) == c_null_char) exit
      text = text//letters(i)
    end do
  end function nearwall_text
end module nearwall
