//! Facts of the case that are recorded in the files of a run.

use railcrack::bulk::Boundary;
use railcrack::fatigue::RailSteel;
use railcrack::growth::{Mgt, SurfaceRemoval, Warning};
use railcrack_case::{
    CalibrationPrior, ContactSolver, Engine, Inspection, InspectionRisk, Output, PlaneEngine, Scatter,
};

/// A wheel of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelInfo {
    /// Its name.
    pub name: String,
    /// Share of the axles.
    pub share: f64,
    /// Load of one of its axles, t.
    pub axle_load: Option<f64>,
    /// Half-width of its contact, mm.
    pub half_width: f64,
}

/// Facts of the case that are recorded in the files of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunInfo {
    /// Title of the case.
    pub title: String,
    /// Engine.
    pub engine: Engine,
    /// Contact solver.
    pub contact: ContactSolver,
    /// Boundary of the rail.
    pub boundary: Boundary,
    /// First and last position of `[passage]`, mm: a rail that bends has output positions beyond.
    pub passage: [f64; 2],
    /// Whether a rail bends on its track that is cracked as a half-plane.
    pub bends: bool,
    /// K_Ic, MPa √m, where the case gives it.
    pub toughness: Option<f64>,
    /// The steel that the case names for its growth law.
    pub steel: Option<&'static RailSteel>,
    /// The data of the calibration of the case, if it has one.
    pub calibration: CalibrationPrior,
    /// ΔK_eq (MPa√m) of the first and the last row of the growth law, where it is a table.
    pub law_table: Option<(f64, f64)>,
    /// Whether there is fluid in the cracks.
    pub fluid: bool,
    /// Whether a wheel feels the cracks.
    pub coupled: bool,
    /// Mean axle load in tonnes, for million gross tonnes.
    pub axle_load: Option<f64>,
    /// The wheels, at least one; positions are measured in the half-width of the first.
    pub wheels: Vec<WheelInfo>,
    /// Wear and grinding, where the case has them.
    pub maintenance: Option<SurfaceRemoval<Mgt>>,
    /// The inspection, where the case has one.
    pub inspection: Option<Inspection>,
    /// The risk between inspections, where the case has one.
    pub inspection_risk: Option<InspectionRisk>,
    /// Million gross tonnes per year, where the case gives them.
    pub mgt_per_year: Option<f64>,
    /// The scatter, where the case gives it and the run is to sample it.
    pub scatter: Option<Scatter>,
    /// The length that ends the run, mm.
    pub critical_length: Option<f64>,
    /// Tables, plots and page that are written.
    pub output: Output,
    /// Depths (mm) between which the steel flows in each passage of a wheel beyond the limit of
    /// shakedown; none where it does not.
    pub flowing: Option<[f64; 2]>,
    /// Rate (mm per cycle) below which a tip is arrested.
    pub arrest_rate: f64,
    /// The remark on a growth law of another material or unit.
    pub unusual_law: Option<String>,
    /// Warnings that follow from the case, before any step.
    pub warnings: Vec<Warning>,
}

impl RunInfo {
    /// The facts of an untitled run under one wheel of `half_width` (mm), without anything that a
    /// case may leave out.
    #[must_use]
    pub fn idle(half_width: f64) -> Self {
        Self {
            title: String::new(),
            engine: Engine::Plane(PlaneEngine::Dislocation),
            contact: ContactSolver::Newton,
            boundary: Boundary::HalfPlane,
            wheels: vec![WheelInfo { name: "wheel 1".to_owned(), share: 1.0, axle_load: None, half_width }],
            passage: [-1e9, 1e9],
            bends: false,
            toughness: None,
            steel: None,
            calibration: CalibrationPrior::PLANE,
            law_table: None,
            fluid: false,
            coupled: false,
            axle_load: None,
            maintenance: None,
            inspection: None,
            inspection_risk: None,
            mgt_per_year: None,
            scatter: None,
            critical_length: None,
            output: Output::ALL,
            flowing: None,
            arrest_rate: 0.0,
            unusual_law: None,
            warnings: Vec::new(),
        }
    }

    /// The wheels where there are several, which results then tell apart; none for one wheel.
    #[must_use]
    pub fn mix(&self) -> &[WheelInfo] {
        if self.wheels.len() > 1 { &self.wheels } else { &[] }
    }

    /// Half-width a of the contact of the first wheel, mm: the unit of its `xc_over_a`.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.wheels.first().map_or(0.0, |wheel| wheel.half_width)
    }

    /// Half-widths of the contacts of all wheels, mm.
    #[must_use]
    pub fn half_widths(&self) -> Vec<f64> {
        self.wheels.iter().map(|wheel| wheel.half_width).collect()
    }

    /// The sections of the case that bring columns of their own: `wheel` once for each wheel of a
    /// mix.
    pub fn sections(&self) -> Vec<&'static str> {
        let traffic = self.axle_load.map(|_| "traffic");
        let maintenance = self.maintenance.map(|_| "maintenance");
        let fluid = self.fluid.then_some("fluid");
        let wheels = self.mix().iter().map(|_| "wheel");
        let space = self.engine.is_in_space().then_some("space");
        let coupled = self.coupled.then_some("coupled");
        let all = traffic.into_iter().chain(wheels).chain(maintenance).chain(fluid).chain(space);
        all.chain(coupled).collect()
    }
}
