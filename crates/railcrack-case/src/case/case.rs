//! Checked case: everything that a run computes, in the types of the mechanics.

use super::geometry::{Geometry, PlaneCase};
use super::space_case::SpaceCase;
use super::traffic_wheel::{TrafficWheel, mean_axle_load};
use super::wheel_table::{WheelGroups, WheelTable};
use crate::files::{CaseFile, Companion, CrackTableFile, ProfileFile, RatesFile};
use crate::schema::{Value, Written};
use crate::tables::{
    CONTACT, CalibrationPrior, ContactSolver, Detection, Engine, FieldOutput, Fracture, Inspection,
    InspectionRisk, KIND, MeshSettings, OUTPUT, Output, PlaneEngine, PlasticSource, RUN_FOLDERS, Scatter,
    ShakedownSettings, TITLE, TOP, WHEEL_CONTACT,
};
use railcrack::bulk::Boundary;
use railcrack::crack::CrackNetwork;
use railcrack::fatigue::RailSteel;
use railcrack::growth::{GrowthSettings, Mgt, NetworkContact, SurfaceRemoval};
use railcrack::material::IsotropicElastic;
use railcrack::math::RailBox;

/// Everything in a case file, checked, in the types of the mechanics. Two are equal when their
/// values and the contents of their files are.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Heading of plots and reports.
    pub title: String,
    /// Steel of rail and wheel.
    pub steel: IsotropicElastic,
    /// Extent of the rail, within which the cracks stay.
    pub rail: RailBox,
    /// The wheels that pass, at least one: all those that are given, or instead of the wheels of a
    /// table their representatives.
    pub wheels: Vec<TrafficWheel>,
    /// The table of which the last wheels are, where one is given.
    pub wheel_table: Option<WheelTable>,
    /// The cracks, copies written out: in the order of the file, the copies of each from left to
    /// right.
    pub cracks: CrackNetwork,
    /// Crack-face friction coefficient of each crack, in the order of `cracks`.
    pub crack_friction: Vec<f64>,
    /// The list of an inspection of which cracks are, where one is given.
    pub crack_table: Option<CrackTableFile>,
    /// Balanced residual stress that adds to the wheel.
    pub residual_stress: Option<ProfileFile>,
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
    /// Cracks in the plane or in space.
    pub geometry: Geometry,
    /// How the contact conditions of many cracks are solved.
    pub network: NetworkContact,
    /// Fields that are written.
    pub fields: FieldOutput,
    /// Tables, plots and page that are written.
    pub output: Output,
    /// Mean load of an axle (t) where traffic is given: one passage is one axle.
    pub axle_load: Option<f64>,
    /// Wear and grinding, where they are given.
    pub maintenance: Option<SurfaceRemoval<Mgt>>,
    /// The inspection, where it is given.
    pub inspection: Option<Inspection>,
    /// The risk between inspections, where there is an inspection.
    pub inspection_risk: Option<InspectionRisk>,
    /// Million gross tonnes per year, where they are given.
    pub mgt_per_year: Option<f64>,
    /// The scatter, where it is given.
    pub scatter: Option<Scatter>,
    /// Prior of a calibration.
    pub calibration: CalibrationPrior,
    /// Sections and values as written, defaults filled in.
    pub(super) written: Written,
}

impl Case {
    /// The parts that only the engines in the plane know; none in space.
    #[must_use]
    pub fn plane(&self) -> Option<&PlaneCase> {
        let Geometry::Plane(plane) = &self.geometry else { return None };
        Some(plane)
    }

    /// The parts that only the engine in space knows; none in the plane.
    #[must_use]
    pub fn space(&self) -> Option<&SpaceCase> {
        let Geometry::Space(space) = &self.geometry else { return None };
        Some(space)
    }

    /// Engine that computes the cracked rail.
    #[must_use]
    pub fn engine(&self) -> Engine {
        self.plane().map_or(Engine::Space, |plane| Engine::Plane(plane.engine))
    }

    /// Solver of the contact conditions on the crack faces.
    #[must_use]
    pub fn contact_solver(&self) -> ContactSolver {
        self.plane().map_or(ContactSolver::Newton, |plane| plane.contact_solver)
    }

    /// Boundary of the rail; a half-space has that of the half-plane.
    #[must_use]
    pub fn boundary(&self) -> Boundary {
        self.plane().map_or(Boundary::HalfPlane, |plane| plane.boundary)
    }

    /// Plastic stress, still to be balanced, where it is given.
    #[must_use]
    pub fn plastic_stress(&self) -> Option<&PlasticSource> {
        match &self.geometry {
            Geometry::Plane(plane) => plane.plastic_stress.as_ref(),
            Geometry::Space(space) => space.plastic_stress.as_ref(),
        }
    }

    /// The first wheel, by which positions are measured and whose faces and fields are written.
    #[must_use]
    pub fn first_wheel(&self) -> &TrafficWheel {
        &self.wheels[0]
    }

    /// Whether several wheels pass: results then tell them apart.
    #[must_use]
    pub fn is_mix(&self) -> bool {
        self.wheels.len() > 1
    }

    /// Number of wheels that a run computes, at most: of those of a table its representatives.
    #[must_use]
    pub fn computed_wheels(&self) -> usize {
        let of_table = |table: &WheelTable| table.computed_wheels(&self.wheels);
        self.wheel_table.as_ref().map_or(self.wheels.len(), of_table)
    }

    /// The case under `wheels` that represent those of its table in `groups`.
    #[must_use]
    pub fn represented_by(mut self, wheels: Vec<TrafficWheel>, groups: WheelGroups) -> Self {
        self.axle_load = mean_axle_load(&wheels);
        self.set_maintenance(self.maintenance);
        self.wheels = wheels;
        if let Some(table) = &mut self.wheel_table {
            table.groups = Some(groups);
        }
        self
    }

    /// Whether there is fluid in the cracks, under any wheel.
    #[must_use]
    pub fn has_fluid(&self) -> bool {
        self.wheels.iter().any(|wheel| wheel.fluid.is_some())
    }

    /// Whether a wheel feels the cracks.
    #[must_use]
    pub fn has_coupled_wheel(&self) -> bool {
        self.wheels.iter().any(|wheel| wheel.wheel.coupling().is_some())
    }

    /// Whether the rail bends as a beam under a wheel.
    #[must_use]
    pub fn has_track(&self) -> bool {
        self.wheels.iter().any(|wheel| wheel.wheel.track.is_some())
    }

    /// a, mm: the unit of `[passage]` positions, of the first wheel.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.first_wheel().wheel.half_width()
    }

    /// The positions of a passage of `wheel` that are written, in the order of travel, mm: those of
    /// `[passage]`, and where the rail bends those far away. Of the cracks at the beginning.
    #[must_use]
    pub fn positions(&self, wheel: &TrafficWheel) -> Vec<f64> {
        let points = || self.cracks.cracks().iter().flat_map(|crack| crack.points());
        let mut places: Vec<f64> = points().filter(|point| point.y == 0.0).map(|point| point.x).collect();
        if places.is_empty() {
            places.extend(points().next().map(|point| point.x));
        }
        wheel.wheel.positions(&wheel.passages.passage, &places, &self.steel)
    }

    /// Gives the case another wear and grinding, where it has axle loads.
    pub fn set_maintenance(&mut self, removal: Option<SurfaceRemoval<Mgt>>) {
        self.maintenance = removal;
        self.growth.maintenance =
            removal.zip(self.axle_load).map(|(removal, tonnes)| removal.over_axles(tonnes));
    }

    /// The case with the cracks of the indices `kept` (from 0) alone, resolved as in the whole
    /// case; none in space, and where no crack is kept. Its text is that of the whole case.
    #[must_use]
    pub fn with_cracks(&self, kept: &[usize]) -> Option<Self> {
        let (plane, cracks) = (self.plane()?, self.cracks.part(kept).ok()?);
        let sizes = plane.element_sizes(&self.cracks);
        let size = kept.iter().filter_map(|&crack| sizes.get(crack)).copied().reduce(f64::min);
        let mesh = MeshSettings {
            element_size: size.filter(|_| plane.engine == PlaneEngine::Xfem),
            interface_elements: Some(plane.face_resolution(&self.cracks).elements),
            ..plane.mesh
        };
        let widths = kept.iter().filter_map(|&crack| plane.widths.get(crack)).copied().collect();
        let geometry = Geometry::Plane(PlaneCase { mesh, widths, ..plane.clone() });
        let friction = kept.iter().filter_map(|&crack| self.crack_friction.get(crack)).copied().collect();
        let mut part = Self { geometry, cracks, crack_friction: friction, ..self.clone() };
        let fluids = part.wheels.iter_mut().filter_map(|wheel| wheel.fluid.as_mut());
        for wet in fluids.filter_map(|fluid| fluid.cracks.as_mut()) {
            *wet = (0..kept.len()).filter(|own| wet.contains(&kept[*own])).collect();
        }
        Some(part)
    }

    /// The sections of the contacts that the text of the case gives, such as `contact`.
    #[must_use]
    pub fn contact_sections(&self) -> Vec<String> {
        let numbered = (1..=self.wheels.len() + 1).map(|number| WHEEL_CONTACT.path(number));
        let all = std::iter::once(CONTACT.path(1)).chain(numbered);
        all.filter(|path| self.written.value(path, KIND.key.name).is_some()).collect()
    }

    /// The path of the section, the key and the value of every key, defaults among them.
    pub(crate) fn values(&self) -> impl Iterator<Item = (&str, &'static str, &Value)> {
        self.written.values()
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
        // The tables of a mix are one file, and its profiles one pair.
        let mut wheels = self.wheels.iter().map(|wheel| wheel.wheel.companions());
        let contact = wheels.find(|files| !files.is_empty()).unwrap_or_default();
        let toughness = self.fracture.as_ref().and_then(|fracture| fracture.file.as_ref());
        let detection = self.inspection_risk.as_ref().and_then(|risk| match risk.detection.as_ref()? {
            Detection::Table(file) => Some(file.companion()),
            Detection::LogNormal { .. } => None,
        });
        let others = [
            self.wheel_table.as_ref().map(|table| table.file.companion()),
            self.crack_table.as_ref().map(CaseFile::companion),
            self.residual_stress.as_ref().map(CaseFile::companion),
            self.plastic_stress().and_then(PlasticSource::companion),
            self.shakedown.initial_residual.as_ref().map(CaseFile::companion),
            toughness.map(CaseFile::companion),
            self.growth_rates.as_ref().map(CaseFile::companion),
            detection,
        ];
        contact.into_iter().chain(others.into_iter().flatten()).collect()
    }
}
