//! A case that has passed every check.

use super::accept::Value;
use super::field_file::FieldFile;
use super::profile::ProfileFile;
use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::DangVan;
use railcrack::growth::{GrowthSettings, PassageSettings};
use railcrack::load::HertzianContact;
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::{Method, RolledRail, Stabilisation, Travel};

/// What is to be computed: everything in a case file, checked, in the types of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Heading of plots and reports.
    pub title: String,
    /// Steel of rail and wheel.
    pub steel: IsotropicElastic,
    /// Extent of the rail.
    pub rail: Rail,
    /// Wheel on rail.
    pub contact: HertzianContact,
    /// Output positions, and how passages are repeated and resolved.
    pub passages: PassageSettings,
    /// The cracks, copies written out: in the order of the file, the copies of each from left to right.
    pub cracks: CrackNetwork,
    /// Friction coefficient of the faces of each crack.
    pub crack_friction: Vec<f64>,
    /// Balanced residual stress that adds to the wheel.
    pub residual_stress: Option<ProfileFile>,
    /// Plastic stress, still to be balanced.
    pub plastic_stress: Option<PlasticSource>,
    /// Plastic behaviour under the repeated passage.
    pub shakedown: ShakedownSettings,
    /// How cracks grow and when a run ends.
    pub growth: GrowthSettings,
    /// Discretisation.
    pub mesh: MeshSettings,
    /// What computes the cracked rail.
    pub engine: Engine,
    /// What solves the contact of the crack faces.
    pub contact_solver: ContactSolver,
    /// Fields that are written.
    pub fields: FieldOutput,
    /// Load of one axle, t.
    pub axle_load: Option<f64>,
    /// Sections and values as written, defaults filled in.
    pub(super) written: Vec<(&'static str, Vec<(&'static str, Value)>)>,
}

/// Extent of the rail: cracks stay in `centre` ± `width` / 2 and above −`depth`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rail {
    /// Length along x, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
    /// Abscissa of the middle, mm.
    pub centre: f64,
    /// What the rail ends at.
    pub boundary: Boundary,
}

/// Where a plastic stress comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum PlasticSource {
    /// A field on a mesh.
    Field(FieldFile),
    /// A profile by depth.
    Profile(ProfileFile),
    /// The stabilised state under the wheel of the case, computed first.
    Rolled,
}

/// Plastic behaviour of the rail and the criterion of initiation.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakedownSettings {
    /// Yield stress and hardening of the steel.
    pub hardening: KinematicHardening,
    /// Way to the stabilised state.
    pub method: Method,
    /// Passages after which the rail counts as not stabilised.
    pub max_passes: usize,
    /// Balanced profile present before the first passage.
    pub initial_residual: Option<ProfileFile>,
    /// The criterion of initiation.
    pub dang_van: DangVan,
}

/// Discretisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshSettings {
    /// Element size at the cracks in the finite-element engine, mm; chosen by the shortest crack where none.
    pub element_size: Option<f64>,
    /// Radius of the √r functions around a tip, mm; chosen by the elements where none.
    pub tip_enrichment_radius: Option<f64>,
    /// Largest distance between face points of the finite-element engine, mm.
    pub interface_spacing: Option<f64>,
    /// Elements along each crack in the dislocation engine; chosen by the number of cracks where none.
    pub interface_elements: Option<usize>,
}

/// Fields that are written.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOutput {
    /// Wheel positions x_c/a, from the mouth of the first crack.
    pub over_a: Vec<f64>,
    /// Every how many growth steps; 0 is never.
    pub every: usize,
}

/// What computes the cracked rail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Extended finite elements.
    Xfem,
    /// Distributed dislocations in a half-plane.
    Dislocation,
}

/// What solves the contact of the crack faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactSolver {
    /// Active sets, exact complementarity.
    Newton,
    /// The LATIN method.
    Latin,
}

impl Engine {
    /// Every engine of this version, the default first.
    pub const ALL: [Self; 2] = [Self::Xfem, Self::Dislocation];

    /// The name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xfem => "xfem",
            Self::Dislocation => "dislocation",
        }
    }
}

impl PlasticSource {
    /// The name in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Field(_) => "field",
            Self::Profile(_) => "profile",
            Self::Rolled => "rolled",
        }
    }
}

impl ContactSolver {
    /// The name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Newton => "newton",
            Self::Latin => "latin",
        }
    }
}

/// What the rail ends at, in the words of case files.
pub fn boundary_name(boundary: Boundary) -> &'static str {
    use {BottomSupport as Bottom, SideSupport as Sides};
    match boundary {
        Boundary::HalfPlane => "half-plane",
        Boundary::Block { bottom, sides } => match (bottom, sides) {
            (Bottom::Clamped, Sides::Free) => "block, bottom clamped, sides free",
            (Bottom::Clamped, Sides::Rollers) => "block, bottom clamped, sides rollers",
            (Bottom::Clamped, Sides::Clamped) => "block, bottom clamped, sides clamped",
            (Bottom::Rollers, Sides::Free) => "block, bottom rollers, sides free",
            (Bottom::Rollers, Sides::Rollers) => "block, bottom rollers, sides rollers",
            (Bottom::Rollers, Sides::Clamped) => "block, bottom rollers, sides clamped",
        },
    }
}

/// A file that belongs beside the text of [`Case::to_toml`], under the name by which that text calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Companion<'a> {
    /// Its name, relative to the folder of the case file, with `/`.
    pub name: &'static str,
    /// Its content.
    pub text: &'a str,
}

/// Where a run folder keeps the profile of `[residual_stress]`.
pub(super) const RESIDUAL_STRESS_NAME: &str = "inputs/residual-stress.csv";

/// Where a run folder keeps the field of `[plastic_stress]`.
pub(super) const PLASTIC_FIELD_NAME: &str = "inputs/plastic-stress.vtu";

/// Where a run folder keeps the profile of `[plastic_stress]`.
pub(super) const PLASTIC_PROFILE_NAME: &str = "inputs/plastic-stress.csv";

/// Where a run folder keeps the profile of `[shakedown] initial_residual`.
pub(super) const INITIAL_RESIDUAL_NAME: &str = "inputs/initial-residual.csv";

impl Case {
    /// The rail without its cracks, under the repeated passage of the wheel.
    pub fn rolled_rail(&self) -> RolledRail {
        let passage = &self.passages.passage;
        RolledRail {
            steel: self.steel,
            hardening: self.shakedown.hardening,
            contact: self.contact,
            travel: if passage.from < passage.to { Travel::Forward } else { Travel::Backward },
            initial: self.shakedown.initial_residual.as_ref().map(|file| file.profile().clone()),
        }
    }

    /// How its stabilised state is sought.
    pub fn stabilisation(&self) -> Stabilisation {
        let ShakedownSettings { method, max_passes, .. } = self.shakedown;
        Stabilisation { method, max_passes, ..Stabilisation::default() }
    }

    /// The same case with another title.
    pub(super) fn titled(mut self, title: &str) -> Self {
        for (section, values) in &mut self.written {
            if section.is_empty() {
                for (_, value) in values.iter_mut().filter(|(key, _)| *key == "title") {
                    *value = Value::Text(title.into());
                }
            }
        }
        self.title = title.into();
        self
    }

    /// The files that the text of [`Case::to_toml`] names: a folder with that text and these files is complete.
    pub fn companions(&self) -> Vec<Companion<'_>> {
        let mut companions = Vec::new();
        if let Some(profile) = &self.residual_stress {
            companions.push(Companion { name: RESIDUAL_STRESS_NAME, text: profile.text() });
        }
        match &self.plastic_stress {
            Some(PlasticSource::Field(file)) => {
                companions.push(Companion { name: PLASTIC_FIELD_NAME, text: file.text() });
            }
            Some(PlasticSource::Profile(file)) => {
                companions.push(Companion { name: PLASTIC_PROFILE_NAME, text: file.text() });
            }
            Some(PlasticSource::Rolled) | None => {}
        }
        if let Some(profile) = &self.shakedown.initial_residual {
            companions.push(Companion { name: INITIAL_RESIDUAL_NAME, text: profile.text() });
        }
        companions
    }
}
