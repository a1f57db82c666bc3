//! `fitted-form`: a closed form over one input or group, fitted without a law.
//!
//! `f` is the value of one of [`FORMS`](super::FORMS); it replaces `e_n`, `e_t` or the probability of capture,
//! or corrects them as a curve does ([`correction`](super::correction)). No physics: it holds for the data of
//! the fit (`valid`), and goes on beyond them. An impact whose input or group has no value is left unchanged.

use super::{Correction, CurveInput, CurveTarget, Effect, EffectInfo, FormInfo, Operation};
use crate::group::{Circumstances, Declared};

pub(super) const INFO: EffectInfo = EffectInfo {
    id: "fitted-form",
    about: "a closed form over one input or group, fitted without a law",
    inputs: &[],
    stream: None,
    parameters: &[],
    build: |_| Box::new(FittedForm::nothing()),
};

/// A closed form over one input or group.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedForm {
    /// What it acts on.
    pub on: CurveTarget,
    /// How.
    pub acts: Operation,
    /// The form.
    pub form: &'static FormInfo,
    /// Its input.
    pub input: CurveInput,
    /// The parameters of the form, in its order; with another number of them it does nothing.
    pub parameters: Vec<f64>,
}

impl FittedForm {
    /// A constant without a value does nothing.
    fn nothing() -> Self {
        let (on, acts) = (CurveTarget::NormalRestitution, Operation::Add);
        let [form, ..] = &super::FORMS;
        Self { on, acts, form, input: CurveInput::Input(0), parameters: Vec::new() }
    }
}

impl Effect for FittedForm {
    fn correction(&self) -> Option<&dyn Correction> {
        Some(self)
    }
}

impl Correction for FittedForm {
    fn on(&self) -> CurveTarget {
        self.on
    }

    fn acts(&self) -> Operation {
        self.acts
    }

    fn value(&self, of: &dyn Circumstances) -> Option<f64> {
        let x = self.input.value(of);
        let value = self.form.value(&self.parameters, x);
        (!x.is_nan() && !value.is_nan()).then_some(value)
    }

    fn inputs(&self) -> Vec<CurveInput> {
        vec![self.input]
    }

    fn describe(&self, declared: &Declared<'_>) -> String {
        let Self { form, .. } = self;
        let values = form.parameters.iter().zip(&self.parameters);
        let values: Vec<String> = values.map(|(one, value)| format!("{} = {value}", one.name)).collect();
        let acts = self.acts.describe(self.on);
        format!("{acts}, f = {}, {}, x = {}", form.equation, values.join(", "), self.input.name(declared))
    }
}
