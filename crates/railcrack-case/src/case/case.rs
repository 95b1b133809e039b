//! Checked case: everything that a run computes, in the types of the mechanics.

use crate::files::{Companion, ProfileFile, RatesFile};
use crate::schema::{Value, Written};
use crate::tables::{
    ContactSolver, Engine, FieldOutput, MeshSettings, PlasticSource, Rail, ShakedownSettings, TITLE, TOP,
};
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::RailSteel;
use railcrack::growth::{GrowthSettings, PassageSettings};
use railcrack::load::HertzianContact;
use railcrack::material::IsotropicElastic;
use railcrack::shakedown::{RolledRail, Stabilisation, Travel};

/// Everything in a case file, checked, in the types of the mechanics. Two are equal when their
/// values and the contents of their files are.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Heading of plots and reports.
    pub title: String,
    /// Steel of rail and wheel.
    pub steel: IsotropicElastic,
    /// Extent and boundary of the rail.
    pub rail: Rail,
    /// Wheel on rail.
    pub contact: HertzianContact,
    /// Output positions; repetition and resolution of the passages.
    pub passages: PassageSettings,
    /// The cracks, copies written out: in the order of the file, the copies of each from left to
    /// right.
    pub cracks: CrackNetwork,
    /// Crack-face friction coefficient of each crack, in the order of `cracks`.
    pub crack_friction: Vec<f64>,
    /// Balanced residual stress that adds to the wheel.
    pub residual_stress: Option<ProfileFile>,
    /// Plastic stress, still to be balanced.
    pub plastic_stress: Option<PlasticSource>,
    /// Plastic behaviour under the repeated passage.
    pub shakedown: ShakedownSettings,
    /// Rate and direction of growth, and the end of the run.
    pub growth: GrowthSettings,
    /// The steel whose growth law it is, where it is one with a name.
    pub growth_steel: Option<&'static RailSteel>,
    /// The file of the growth law, where it is a table.
    pub growth_rates: Option<RatesFile>,
    /// Discretisation.
    pub mesh: MeshSettings,
    /// Engine that computes the cracked rail.
    pub engine: Engine,
    /// Solver of the contact conditions on the crack faces.
    pub contact_solver: ContactSolver,
    /// Fields that are written.
    pub fields: FieldOutput,
    /// Load of one axle (t) where traffic is given: one passage is one axle.
    pub axle_load: Option<f64>,
    /// Sections and values as written, defaults filled in.
    pub(super) written: Written,
}

impl Case {
    /// The rail without its cracks under the repeated passage of the wheel.
    #[must_use]
    pub fn rolled_rail(&self) -> RolledRail {
        let passage = &self.passages.passage;
        RolledRail {
            steel: self.steel,
            hardening: self.shakedown.hardening,
            contact: self.contact,
            travel: if passage.from < passage.to { Travel::Forward } else { Travel::Backward },
            initial: self.shakedown.initial_residual.as_ref().map(|file| file.content().clone()),
        }
    }

    /// Settings of the way to its stabilised state.
    #[must_use]
    pub fn stabilisation(&self) -> Stabilisation {
        let ShakedownSettings { method, max_passes, .. } = self.shakedown;
        Stabilisation { method, max_passes, ..Stabilisation::default() }
    }

    /// The same case with another title.
    #[must_use]
    pub(crate) fn titled(mut self, title: &str) -> Self {
        self.written.replace(&TOP, TITLE, &Value::Text(title.into()));
        self.title = title.into();
        self
    }

    /// The case as read, every default filled in, as a case file. Files that it names are those of
    /// [`Case::companions`].
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.written.to_toml()
    }

    /// The files that the text of [`Case::to_toml`] names: a folder with that text and these files
    /// is complete, and [`Case::read`] gives an equal case from it.
    #[must_use]
    pub fn companions(&self) -> Vec<Companion<'_>> {
        let plastic = self.plastic_stress.as_ref().and_then(|source| match source {
            PlasticSource::Field(file) => Some(file.companion()),
            PlasticSource::Profile(file) => Some(file.companion()),
            PlasticSource::Rolled => None,
        });
        let residual = self.residual_stress.as_ref().map(ProfileFile::companion);
        let initial = self.shakedown.initial_residual.as_ref().map(ProfileFile::companion);
        let rates = self.growth_rates.as_ref().map(RatesFile::companion);
        residual.into_iter().chain(plastic).chain(initial).chain(rates).collect()
    }
}
