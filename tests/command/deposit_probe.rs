//! Heat through deposits on cooled probes as published beside standalone cases, nothing fitted:
//! `tests/data/deposit_probe.csv` has each source, the inputs and what was assumed. The printed temperature
//! of a clean probe sets the coefficient of its coolant; the temperature under the deposit is computed.

use std::path::Path;

use nearwall_lab::results::standalone::run;
use nearwall_lab::simulate::Case;

const DATA: &str = include_str!("../data/deposit_probe.csv");
const PAGE: &str = include_str!("../../docs/why/physics.md");

/// Heat exchange with a furnace, weak and strong: coefficient of the gas [W/(m² K)], emissivity [1]. Assumed.
const EXCHANGES: [[f64; 2]; 2] = [[20.0, 0.5], [50.0, 0.8]];

/// Coefficient of a coolant [W/(m² K)] where no clean temperature is printed: assumed.
const COOLANT: f64 = 2000.0;

/// Rows whose printed and computed ranges meet.
const AGREE: usize = 3;

/// Stefan–Boltzmann constant [W/(m² K⁴)].
const SIGMA: f64 = 5.670374419e-8;

/// Everything but the wall. The particle flies past; gas conducts as air (assumed). Soot: assumed.
const CASE: &str = r#"
[model.particle]
material = "ASH"
[model.walls.default]
material = "ASH"
layer_thickness = THICKNESS
[model.normal]
model = "constant"
e_n = 0.5
[model.tangential]
model = "constant"
e_t = 0.8
[model.materials.soot]
density = 1850
youngs_modulus = 1e10
poisson_ratio = 0.2
yield_strength = 1e8
surface_energy = 0.1
thermal_conductivity = 1
emissivity = 0.9
CAPTURE
[run]
time_limit = 1
[gas]
field = "uniform"
velocity = [0, 0, 0]
temperature = GAS
density = 0.3
viscosity = 4e-5
conductivity = { T = [300, 500, 1000, 1500], value = [0.026, 0.039, 0.067, 0.09] }
heat_capacity = 1100
[particles]
count = 1
position = { shape = "point", at = [0, 0, 1] }
direction = [1, 0, 0]
speed = 3
diameter = 1e-4
temperature = 300
sizes_count = "mass"
mass = 1e-15
[[walls]]
name = "probe"
wall = "default"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
radius = 0.01
[walls.cooling]
coolant_temperature = OIL
coolant_coefficient = COEFFICIENT
thickness = 0
conductivity = 1
gas_coefficient = EXCHANGE
gas_temperature = GAS
emissivity = EMISSIVITY
surroundings_temperature = GAS
[deposit]
duration = DURATION
steps = 50
voidage = VOIDS
bins = 1
"#;

const SINTERING: &str =
    "[model.capture]\nmodel = \"viscosity\"\nlaw = \"kalmanovitch-frank\"\nreference_viscosity = 1e5";

/// One published number.
struct Row {
    fields: csv::StringRecord,
    header: csv::StringRecord,
}

impl Row {
    fn text(&self, column: &str) -> &str {
        let place = self.header.iter().position(|name| name == column).unwrap();
        &self.fields[place]
    }

    fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{}.{column}", self.text("id")))
    }

    fn is_temperature(&self) -> bool {
        self.text("quantity") == "wall_temperature"
    }

    /// Coefficient of the coolant [W/(m² K)] with which a clean probe has its printed temperature.
    fn coolant(&self, [exchange, emissivity]: [f64; 2]) -> f64 {
        if self.text("clean_K").is_empty() {
            return COOLANT;
        }
        let [gas, clean] = ["gas_K", "clean_K"].map(|column| self.number(column));
        let flux = exchange * (gas - clean) + emissivity * SIGMA * (gas.powi(4) - clean.powi(4));
        flux / (clean - self.number("coolant_K"))
    }

    /// Temperature of the wall [K] and effective conductivity of the layer [W/(m K)] in the end.
    fn simulate(&self, exchange: [f64; 2], thickness: f64, voids: f64) -> [f64; 2] {
        let sinters = self.number("sinters_h");
        let text = [
            ("CAPTURE", if sinters > 0.0 { SINTERING.to_owned() } else { String::new() }),
            ("ASH", self.text("ash").to_owned()),
            ("THICKNESS", thickness.to_string()),
            ("GAS", self.text("gas_K").to_owned()),
            ("OIL", self.text("coolant_K").to_owned()),
            ("COEFFICIENT", format!("{:?}", self.coolant(exchange))),
            ("EXCHANGE", exchange[0].to_string()),
            ("EMISSIVITY", exchange[1].to_string()),
            ("DURATION", (3600.0 * sinters.max(1.0)).to_string()),
            ("VOIDS", voids.to_string()),
        ];
        let text = text.iter().fold(CASE.to_owned(), |text, (key, value)| text.replace(key, value));
        let mut case = Case::from_toml("case.toml", &text, Path::new(".")).unwrap();
        let runs = run::<String>(&mut case, |_, _, _, _| Ok(())).unwrap();
        let bin = &runs[0].deposits.as_ref().unwrap().walls[0].bins[0];
        let (heat, state) = (bin.heat.last().unwrap(), bin.states.last().unwrap());
        let drop = heat.surface_temperature - heat.wall_temperature;
        [heat.wall_temperature, heat.heat_flux * state.layer_thickness(voids) / drop]
    }

    /// Least and largest of the compared quantity.
    fn computed(&self) -> [f64; 2] {
        let place = usize::from(!self.is_temperature());
        let ends = ["low", "high"];
        let all = EXCHANGES.iter().flat_map(|&exchange| {
            ends.map(|end| {
                let thickness = self.number(&format!("thickness_{end}"));
                self.simulate(exchange, thickness, self.number(&format!("voids_{end}")))[place]
            })
        });
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], one| [low.min(one), high.max(one)])
    }

    /// A number as the table and the page print it.
    fn print(&self, number: f64) -> String {
        if self.is_temperature() { format!("{number:.0}") } else { format!("{number:.3}") }
    }
}

fn rows() -> Vec<Row> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(DATA.as_bytes());
    let header = reader.headers().unwrap().clone();
    reader.records().map(|fields| Row { fields: fields.unwrap(), header: header.clone() }).collect()
}

/// What the table states as computed is computed and stands on the page. A row agrees where the ranges
/// meet; one that does not says why.
#[test]
fn published_deposits_conduct_as_the_table_says() {
    let mut agree = Vec::new();
    for row in rows() {
        let id = row.text("id");
        let computed = row.computed();
        let said = computed.map(|number| row.print(number));
        println!("{id}: {computed:?}, printed {} to {}", row.text("printed_low"), row.text("printed_high"));
        let stated = ["computed_low", "computed_high"].map(|column| row.text(column).to_owned());
        assert_eq!(said, stated, "{id}");
        let meets = computed[0] <= row.number("printed_high") && row.number("printed_low") <= computed[1];
        assert_eq!(row.text("agrees"), if meets { "yes" } else { "no" }, "{id}");
        assert_eq!(meets, row.text("why").is_empty(), "{id}: why");
        let cell = format!("| {} to {} |", said[0], said[1]);
        let on_page = |line: &str| line.starts_with("| ") && line.contains(id) && line.contains(&cell);
        assert!(PAGE.lines().any(on_page), "{id}: {cell}");
        if meets {
            agree.push(id.to_owned());
        }
    }
    assert_eq!(agree.len(), AGREE, "{agree:?}");
}

/// The printed temperature of the clean probe comes out of the case. A deposit makes the probe colder, the
/// more so the more voids it has, but never colder than its oil.
#[test]
fn a_clean_probe_has_its_printed_temperature() {
    for row in rows().iter().filter(|row| row.is_temperature()) {
        for exchange in EXCHANGES {
            let [clean, _] = row.simulate(exchange, 0.0, 0.5);
            assert!((clean - row.number("clean_K")).abs() < 1e-3, "{}: {clean}", row.text("id"));
            let [dense, _] = row.simulate(exchange, row.number("thickness_low"), 0.4);
            let [loose, _] = row.simulate(exchange, row.number("thickness_low"), 0.7);
            assert!(row.number("coolant_K") < loose && loose < dense && dense < clean, "{loose} {dense}");
        }
    }
}
