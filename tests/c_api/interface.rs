//! What `nearwall.h` declares, for macros of the tests. Generated: `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.

macro_rules! for_each_function {
    ($define:ident) => {
        $define! {
            nw_abi_version: unsafe extern "C" fn() -> u32,
            nw_version: unsafe extern "C" fn() -> *const c_char,
            nw_status_text: unsafe extern "C" fn(i32) -> *const c_char,
            nw_regime_name: unsafe extern "C" fn(u32) -> *const c_char,
            nw_model_load: unsafe extern "C" fn(*const c_char, *mut *mut nw_model, *mut c_char, usize) -> i32,
            nw_model_parse: unsafe extern "C" fn(*const c_char, usize, *const c_char, *mut *mut nw_model, *mut c_char, usize) -> i32,
            nw_model_free: unsafe extern "C" fn(*mut nw_model),
            nw_model_find_wall: unsafe extern "C" fn(*const nw_model, *const c_char, *mut u32) -> i32,
            nw_impact_init: unsafe extern "C" fn(*mut nw_impact) -> i32,
            nw_outcome_init: unsafe extern "C" fn(*mut nw_outcome) -> i32,
            nw_resolve: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut nw_outcome) -> i32,
            nw_explain: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut c_char, usize) -> i32,
            nw_beyond: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut c_char, usize) -> i32,
            nw_unlikely: unsafe extern "C" fn(*const nw_impact, *mut c_char, usize) -> i32,
            nw_key_of_values: unsafe extern "C" fn(*const f64, usize, *mut u64) -> i32,
            nw_speeds: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut f64, *mut f64, *mut f64) -> i32,
            nw_particle_density: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut f64) -> i32,
            nw_erosion: unsafe extern "C" fn(*const nw_model, *const nw_impact, f64, *mut f64) -> i32,
            nw_temperature_ranges: unsafe extern "C" fn(*const nw_model, u32, *mut f64, *mut f64, *mut f64, *mut f64) -> i32,
            nw_resolve_batch: unsafe extern "C" fn(*const nw_model, *const nw_impacts, *const nw_outcomes, *mut usize) -> i32,
            nw_wall_cooling_init: unsafe extern "C" fn(*mut nw_wall_cooling) -> i32,
            nw_wall_heat_init: unsafe extern "C" fn(*mut nw_wall_heat) -> i32,
            nw_deposit_heat: unsafe extern "C" fn(*const nw_model, *const nw_deposit, f64, *const nw_wall_cooling, *mut nw_wall_heat) -> i32,
            nw_contact_heat: unsafe extern "C" fn(*const nw_model, *const nw_impact, *mut f64) -> i32,
            nw_heat_brought: unsafe extern "C" fn(*const nw_model, *const nw_impact, f64, *mut f64) -> i32,
            nw_deposit_init: unsafe extern "C" fn(*mut nw_deposit) -> i32,
            nw_deposit_initial: unsafe extern "C" fn(*const nw_model, f64, *mut nw_deposit) -> i32,
            nw_deposit_source_init: unsafe extern "C" fn(*mut nw_deposit_source) -> i32,
            nw_deposit_source_add: unsafe extern "C" fn(*const nw_model, *const nw_impact, f64, f64, *mut nw_deposit_source) -> i32,
            nw_deposit_add: unsafe extern "C" fn(*const nw_deposit_source, *mut nw_deposit) -> i32,
            nw_deposit_apply: unsafe extern "C" fn(*const nw_model, *const nw_deposit, f64, *mut nw_impact) -> i32,
            nw_film_velocity: unsafe extern "C" fn(*const nw_model, *const nw_deposit, f64, f64, *mut f64) -> i32,
            nw_cooled_film_velocity: unsafe extern "C" fn(*const nw_model, *const nw_deposit, f64, f64, f64, *mut f64) -> i32,
            nw_extra_input_count: unsafe extern "C" fn(*const nw_model, *mut u32) -> i32,
            nw_extra_input_name: unsafe extern "C" fn(*const nw_model, u32, *mut c_char, usize) -> i32,
            nw_extra_input_default: unsafe extern "C" fn(*const nw_model, u32, *mut f64) -> i32,
            nw_extra_input_word: unsafe extern "C" fn(*const nw_model, u32, u32, *mut c_char, usize) -> i32,
            nw_extra_input_value: unsafe extern "C" fn(*const nw_model, u32, *const c_char, *mut f64, *mut c_char, usize) -> i32,
            nw_deposit_surroundings_init: unsafe extern "C" fn(*mut nw_deposit_surroundings) -> i32,
            nw_deposit_losses_init: unsafe extern "C" fn(*mut nw_deposit_losses) -> i32,
            nw_deposit_advance: unsafe extern "C" fn(*const nw_model, *const nw_deposit_surroundings, *const nw_wall_cooling, f64, *mut nw_deposit, *mut nw_deposit_losses) -> i32,
            nw_wall_processes: unsafe extern "C" fn(*const nw_model, u32, *mut u32) -> i32,
            nw_process_name: unsafe extern "C" fn(u32) -> *const c_char,
            nw_process_loss: unsafe extern "C" fn(u32) -> *const c_char,
            nw_process_gain: unsafe extern "C" fn(u32) -> *const c_char,
            nw_walk_init: unsafe extern "C" fn(*mut nw_walk) -> i32,
            nw_walk_advance: unsafe extern "C" fn(*mut nw_walk) -> i32,
            nw_thermophoresis: unsafe extern "C" fn(f64, f64, f64, f64, f64, f64, f64, *mut f64) -> i32,
        }
    };
}

macro_rules! for_each_struct {
    ($define:ident) => {
        $define! {
            nw_impact { struct_size wall seed key v_n v_t omega d T_p rho_p conversion T_w T_under roughness coverage layer_thickness film_thickness melt_thickness v_gas extra }
            nw_outcome { struct_size regime stuck flags e_n e_t p_stick omega }
            nw_impacts { struct_size wall count seed walls key v_n v_t omega d T_p rho_p conversion T_w T_under roughness coverage layer_thickness film_thickness melt_thickness v_gas extra }
            nw_outcomes { struct_size e_n e_t p_stick omega regime stuck flags }
            nw_wall_cooling { struct_size reserved coolant_temperature coolant_coefficient wall_resistance gas_temperature gas_coefficient emissivity irradiation further_flux gas_conductivity void_temperature other_conductivity other_temperature vapour_fraction vapour_coefficient }
            nw_wall_heat { struct_size reserved surface_temperature wall_temperature heat_flux coolant_flux deposit_resistance disagreement behind_temperature behind_resistance }
            nw_deposit { struct_size wall molten powder solid cover conversion closed resuspended frozen behind }
            nw_deposit_source { struct_size count molten powder solid cover buried converted }
            nw_deposit_surroundings { struct_size reserved voidage wall_temperature gas_density kinematic_viscosity shear_down shear_across gravity_outward gravity_along draw }
            nw_deposit_losses { struct_size reserved mass heat_taken heat_to_coolant heat_of_fusion heat_released deposit_resistance }
            nw_walk { struct_size reserved seed key step duration relaxation_time friction_velocity kinematic_viscosity wall_distance normal flow core_fluctuation core_time core_gradient values velocity longest_step }
        }
    };
}

macro_rules! for_each_number {
    ($define:ident) => {
        $define! {
            NW_ABI_VERSION
            NW_EXTRA_INPUTS
            NW_PROCESSES
            NW_DIRECTIONS
            NW_OUTSIDE_VALID_RANGE
            NW_OK
            NW_NULL_POINTER
            NW_STRUCT_SIZE
            NW_NOT_UTF8
            NW_FILE
            NW_MODEL
            NW_UNKNOWN_WALL
            NW_BAD_STATE
            NW_OUT_OF_RANGE
            NW_PANIC
            NW_UNKNOWN_INPUT
            NW_NO_CONDUCTIVITY
            NW_NO_HEAT_CAPACITY
            NW_NSP_NSW
            NW_NSP_SW
            NW_SP_NSW
            NW_SP_SW
        }
    };
}

pub(crate) use {for_each_function, for_each_number, for_each_struct};
