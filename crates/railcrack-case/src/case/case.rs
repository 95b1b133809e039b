//! Checked case: everything that a run computes, in the types of the mechanics.

use super::mix::MixedWheel;
use super::space_case::SpaceCase;
use crate::files::{Companion, ProfileFile, RatesFile, ToughnessFile};
use crate::schema::{Value, Written};
use crate::tables::{
    ContactSolver, Engine, FieldOutput, Fracture, GivenWheel, Inspection, MaintenancePlan, MeshSettings,
    OUTPUT, Output, PlasticSource, RUN_FOLDERS, Rail, Scatter, ShakedownSettings, TITLE, TOP,
};
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::RailSteel;
use railcrack::growth::{GrowthSettings, PassageSettings};
use railcrack::material::IsotropicElastic;
use railcrack::plane::{CrackFluid, NetworkContact};
use railcrack::shakedown::{ContactBounds, RolledRail, Stabilisation};
use thiserror::Error;

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
    /// The load of the wheel: contact, bending, temperature.
    pub wheel: GivenWheel,
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
    /// Fluid in the cracks, where it is given.
    pub fluid: Option<CrackFluid>,
    /// Plastic behaviour under the repeated passage.
    pub shakedown: ShakedownSettings,
    /// Rate and direction of growth, and the end of the run.
    pub growth: GrowthSettings,
    /// The steel whose growth law it is, where it is one with a name.
    pub growth_steel: Option<&'static RailSteel>,
    /// The file of the growth law, where it is a table.
    pub growth_rates: Option<RatesFile>,
    /// Brittle fracture, where it is given.
    pub fracture: Option<Fracture>,
    /// Crack and wheel in space, for that engine.
    pub space: Option<SpaceCase>,
    /// Discretisation.
    pub mesh: MeshSettings,
    /// Engine that computes the cracked rail.
    pub engine: Engine,
    /// Solver of the contact conditions on the crack faces.
    pub contact_solver: ContactSolver,
    /// How the contact conditions of many cracks are solved.
    pub network: NetworkContact,
    /// Fields that are written.
    pub fields: FieldOutput,
    /// Tables, plots and page that are written.
    pub output: Output,
    /// Mean load of an axle (t) where traffic is given: one passage is one axle.
    pub axle_load: Option<f64>,
    /// The wheels of a mix, the first of which is `wheel`; empty for one wheel.
    pub mix: Vec<MixedWheel>,
    /// Wear and grinding, where they are given.
    pub maintenance: Option<MaintenancePlan>,
    /// The inspection, where it is given.
    pub inspection: Option<Inspection>,
    /// The scatter, where it is given.
    pub scatter: Option<Scatter>,
    /// Sections and values as written, defaults filled in.
    pub(super) written: Written,
}

/// A load under which no plastic state is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "[{section}]: the plastic state is computed for the contact alone, whose stress passes and leaves; {reason}. Leave [{section}] out to compute it"
)]
pub struct RolledRailError {
    /// The section that gives it.
    pub section: &'static str,
    /// Why not.
    pub reason: &'static str,
}

impl Case {
    /// The rail without its cracks under the repeated passage of the contact.
    ///
    /// Errors: a rail that bends, or that is not at its neutral temperature.
    pub fn rolled_rail(&self) -> Result<RolledRail, RolledRailError> {
        if self.wheel.load.track.is_some() {
            let reason = "bending is not a field of the yielding half-plane, and it reaches metres beyond it";
            return Err(RolledRailError { section: "track", reason });
        }
        if self.wheel.load.temperature.is_some() {
            let reason = "years of rolling cover all temperatures, not only the one of this section";
            return Err(RolledRailError { section: "temperature", reason });
        }
        Ok(RolledRail {
            steel: self.steel,
            hardening: self.shakedown.hardening,
            contact: self.wheel.contact().clone(),
            travel: self.passages.passage.travel(),
            initial: self.shakedown.initial_residual.as_ref().map(|file| file.content().clone()),
        })
    }

    /// First yield and shakedown under the contact alone, as `of` asks for them.
    #[must_use]
    pub fn contact_bounds<T>(&self, of: impl FnOnce(&ContactBounds) -> T) -> Option<T> {
        self.wheel.contact_bounds(&self.steel, of)
    }

    /// a, mm: the unit of `[passage]` positions.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.wheel.half_width()
    }

    /// The wheel positions of a passage that are written, in the order of travel, mm: those of
    /// `[passage]`, and where the rail bends those far away. Of the cracks at the beginning.
    #[must_use]
    pub fn positions(&self) -> Vec<f64> {
        let points = || self.cracks.cracks().iter().flat_map(|crack| crack.points());
        let mut places: Vec<f64> = points().filter(|point| point.y == 0.0).map(|point| point.x).collect();
        if places.is_empty() {
            places.extend(points().next().map(|point| point.x));
        }
        self.wheel.positions(&self.passages.passage, &places, &self.steel)
    }

    /// Settings of the computation of its stabilised state.
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

    /// The same case in a folder of its own, as a run of a study has it.
    #[must_use]
    pub(crate) fn in_its_folder(mut self) -> Self {
        self.written.replace(&OUTPUT, RUN_FOLDERS, &Value::Switch(true));
        self.output.run_folders = true;
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
        let toughness = self.fracture.as_ref().and_then(|fracture| fracture.file.as_ref());
        let toughness = toughness.map(ToughnessFile::companion);
        let rates = self.growth_rates.as_ref().map(RatesFile::companion);
        // The tables of a mix are one file.
        let of_mix = || self.mix.iter().find_map(|wheel| wheel.wheel.companion());
        let contact = self.wheel.companion().or_else(of_mix);
        let stresses = residual.into_iter().chain(plastic).chain(initial);
        contact.into_iter().chain(stresses).chain(toughness).chain(rates).collect()
    }
}
