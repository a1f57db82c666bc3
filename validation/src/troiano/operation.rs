//! Table 3: what air flow the stated impact speeds need.

use std::f64::consts::FRAC_PI_4;

use nearwall_lab::report::{Table, number};

use super::passes;
use super::published::{FEED, LEAST_ANGLE, OPERATIONS, Operation, SHALLOW, TUBE};
use crate::oracle::carried::{Air, terminal_speed};
use crate::study::table;
use crate::{Claim, StudyPart};

impl Operation {
    /// Speed [m/s] that an air flow [m³/h at 273 K] of a temperature [°C] gives its particles: air
    /// plus terminal velocity.
    fn carried(&self, flow: f64, celsius: f64) -> f64 {
        let area = FRAC_PI_4 * TUBE[0] * TUBE[0];
        let air = Air::at(celsius + 273.15);
        flow / 3600.0 / area * air.temperature / 273.15 + terminal_speed(self.diameter, &air)
    }

    /// The same at both ends.
    fn ends(&self) -> [f64; 2] {
        [self.carried(self.flow[0], self.air[0]), self.carried(self.flow[1], self.air[1])]
    }

    /// Flow [m³/h at 273 K] that its highest speed needs with air of a temperature [°C].
    fn needed(&self, celsius: f64) -> f64 {
        passes(|flow| self.carried(flow, celsius), self.speed[1], [1.0, 10.0])
    }
}

/// A range in words.
fn span([low, high]: [f64; 2]) -> String {
    if low == high { format!("{low}") } else { format!("{low} to {high}") }
}

/// The part on the operating conditions.
pub(super) fn part() -> StudyPart {
    let mut claims: Vec<Claim> = OPERATIONS.iter().map(air_flow).collect();
    claims.extend([smallest_angle(), batches()]);
    StudyPart {
        heading: "Table 3: the operating conditions".to_owned(),
        text: vec![
            "The paper takes the impact speed as air speed plus terminal velocity. Put into that sum, its \
             air flows (at 273 K, brought to the air's temperature, over the tube's cross-section) do not \
             give its ranges of speed. The speeds enter the other parts as stated; they were measured by \
             camera."
                .to_owned(),
        ],
        tables: vec![speeds()],
        claims,
        ..StudyPart::default()
    }
}

fn speeds() -> Table {
    let row = |operation: &Operation| {
        let [low, high] = operation.ends();
        vec![
            operation.regime.to_owned(),
            span(operation.air),
            span(operation.flow),
            number(operation.diameter * 1e6),
            span(operation.speed),
            format!("{low:.2} to {high:.2}"),
        ]
    };
    table(
        "Table 3, and the speed that follows",
        1,
        "regime | air [°C] | flow [m³/h] | d [µm] | v_i, printed [m/s] | v_i from the flow [m/s]",
        OPERATIONS.iter().map(row).collect(),
    )
}

/// Whether an operation's air flow gives its speeds.
fn air_flow(operation: &Operation) -> Claim {
    let [low, high] = operation.ends();
    let holds = low <= operation.speed[0] && operation.speed[1] <= high;
    let claim = Claim::predicted_statement(
        "Table 3",
        &format!(
            "{}: impact speeds that the air flow gives, air plus terminal velocity [m/s]",
            operation.regime
        ),
        &span(operation.speed),
        &format!("{low:.2} to {high:.2}"),
        holds,
    );
    if holds {
        let [cold, hot] = operation.air;
        claim.because(&format!(
            "{} m/s needs {:.1} m³/h at {cold} °C and {:.1} at {hot} °C: the lower temperatures take more \
             than the stated {}.",
            operation.speed[1],
            operation.needed(cold),
            operation.needed(hot),
            operation.flow[1]
        ))
    } else {
        claim.because(&format!(
            "A laminar profile carries particles near the axis up to twice as fast, and the air that turns \
             aside at the target slows them (last part); the paper counts neither. Plug flow in {:.0} mm.",
            1e3 * TUBE[0]
        ))
    }
}

/// Whether `v_n = 1 m/s` is possible at the smallest angles.
fn smallest_angle() -> Claim {
    let [cold, ..] = &OPERATIONS;
    let limit = cold.speed[1];
    let lowest = |speed: f64| (1.0 / speed).asin().to_degrees();
    let speed = |angle: f64| 1.0 / angle.to_radians().sin();
    let fastest = cold.ends()[1];
    Claim::derived_statement(
        "Table 3, Fig 6",
        "smallest angle with v_n = 1 m/s and v_i up to 3 m/s [°]",
        "10 (e_t is stated at 13)",
        &format!("{:.1}", lowest(limit)),
        lowest(limit) <= LEAST_ANGLE,
    )
    .because(&format!(
        "v_n = 1 m/s at {SHALLOW}° is v_i = {:.1} m/s and at {LEAST_ANGLE}° {:.1} m/s, above the table's \
         {limit} m/s; the largest air flow, {} m³/h, gives {fastest:.1} m/s and {:.0}°. Either v_n was less \
         at the smallest angles or the speeds were higher than the table says. The captions of Figs 6 and 7 \
         say v_i = 1 m/s, which would suit the table; the text says v_n = 1 m/s with v_i rising as \
         1/sin(alpha), and is used here.",
        speed(SHALLOW),
        speed(LEAST_ANGLE),
        cold.flow[1],
        lowest(fastest)
    ))
}

/// Whether the drops of Fig. 14 are of the sizes that were fed.
fn batches() -> Claim {
    let [.., hot] = &OPERATIONS;
    Claim::derived_statement(
        "Table 3, Sec 3.1",
        "sizes of Fig. 14 [µm] inside the batches that were fed",
        "50 to 100",
        "120 ± 20",
        hot.diameter <= FEED[1],
    )
    .because(
        "Either the paper contradicts itself, or the tests at 120 °C used other batches. Table 3 is used.",
    )
}
