//! Synthetic runs: records with the shape of real ones and no mechanics behind them.

// Each test program uses a part of this.
#![allow(dead_code)]

use railcrack::body::FacePoint;
use railcrack::body::{BodyTimes, Face, FieldGrid, FieldLine};
use railcrack::contact::{FaceState, FaceStatus};
use railcrack::crack::{Crack, CrackTip, End};
use railcrack::fracture::Sif;
use railcrack::growth::{
    DeferredGrowth, FaceRecord, FieldRecord, FieldSnapshot, Geometry, GrowthState, PassageRecord, PhaseTimes,
    Piece, PieceCause, PieceKind, PlaneGeometry, PlaneTip, RunStop, SolverCounts, StepRecord, TipGeometry,
    TipRecord, Warning, WarningKind, WheelShares,
};
use railcrack::math::{Stress, Vec2};
use railcrack_run::{CaseFiles, OutputError, Recorder, RunInfo, WheelInfo};
use std::path::{Path, PathBuf};

/// Half-width of the contact, mm.
pub const HALF_WIDTH: f64 = 6.75;

/// A folder that goes away with its owner.
pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("railcrack-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Size of a synthetic run.
#[derive(Debug, Clone, Copy)]
pub struct Size {
    pub increments: usize,
    pub positions: usize,
    pub face_points: usize,
    pub cracks: usize,
}

pub const SMALL: Size = Size { increments: 4, positions: 41, face_points: 12, cracks: 1 };

pub fn info() -> RunInfo {
    RunInfo {
        title: "Synthetic <run> & its \"title\"".to_owned(),
        axle_load: Some(17.0),
        ..RunInfo::idle(HALF_WIDTH)
    }
}

/// A case with a file that it names.
pub fn case() -> CaseFiles {
    case_of(&case_text("[traffic]\naxle_load_t = 17.0"))
}

/// A case with the text `toml`, and the file that it names.
pub fn case_of(toml: &str) -> CaseFiles {
    let table = "depth_mm,sxx_mpa\n0,-100\n5,0\n".to_owned();
    let companions = vec![("inputs/residual-stress.csv".to_owned(), table)];
    CaseFiles { toml: toml.to_owned(), companions, wheel_groups: None }
}

/// The text of a case of one crack in four increments, with `more` sections at its end.
pub fn case_text(more: &str) -> String {
    format!(
        "title = \"synthetic\"\n\
         [contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.025\n\
         [[crack]]\nmouth_mm = 0.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n\
         [residual_stress]\nprofile = \"inputs/residual-stress.csv\"\n\
         [solver]\nengine = \"xfem\"\n{more}\n"
    )
}

/// The facts of a run under two wheels.
pub fn mixed_info() -> RunInfo {
    let wheel = |name: &str, share: f64, half_width: f64| WheelInfo {
        name: name.to_owned(),
        share,
        axle_load: Some(17.0),
        half_width,
    };
    RunInfo { wheels: vec![wheel("heavy", 0.25, HALF_WIDTH), wheel("light", 0.75, 5.0)], ..info() }
}

/// Their case.
pub fn mixed_case() -> CaseFiles {
    let wheel = |name: &str, share: f64, half_width: f64| {
        format!(
            "[[wheel]]\nname = \"{name}\"\nshare = {share}\naxle_load_t = 17.0\n\
             contact = {{ peak_pressure_mpa = 845.0, half_width_mm = {half_width}, friction = 0.1 }}\n"
        )
    };
    let wheels = wheel("heavy", 0.25, HALF_WIDTH) + &wheel("light", 0.75, 5.0);
    let of_one = case_text("");
    let (start, end) = (of_one.find("[contact]").unwrap(), of_one.find("[[crack]]").unwrap());
    case_of(&format!("{}{wheels}{}", &of_one[..start], &of_one[end..]))
}

/// The cracks at the start of `step`.
pub fn cracks(size: Size, step: usize) -> Vec<Crack> {
    let grown = |i: usize| {
        let mut crack = Crack::surface_breaking(3.375 * i as f64, 6.0, 15f64.to_radians()).unwrap();
        for n in 0..step {
            let turn: f64 = if n == 2 { -20.0 } else { -2.0 };
            let reach = 0.04 * crack.length() / (1.0 + i as f64);
            crack = crack.extended(End::Last, reach, turn.to_radians()).unwrap();
        }
        crack
    };
    (0..size.cracks).map(grown).collect()
}

/// The record of `step`, and the state after it.
pub fn step(size: Size, step: usize) -> (StepRecord, GrowthState) {
    let now = cracks(size, step);
    let xc: Vec<f64> = (0..size.positions)
        .map(|i| HALF_WIDTH * (-6.0 + 12.0 * i as f64 / (size.positions - 1) as f64))
        .collect();
    let is_last = step == size.increments;
    let grown = step as f64;
    let sif = |x: f64, tip: usize, passage: usize| {
        let u = x / HALF_WIDTH - 0.5 * tip as f64 - 0.8;
        let locked = if passage == 0 { -0.4 } else { -0.55 };
        let k1 = (9.0 + grown) * (-(u + 1.7).powi(2) * 3.0).exp() - 0.01;
        let k2 = locked + (38.0 + 9.0 * grown) * u * (-u * u * 0.9).exp() * (1.0 - 0.35 * u.tanh());
        Sif { ki: 31.6 * k1.max(0.0), kii: 3.16 * k2 * (1.0 - 0.05 * tip as f64) }
    };
    let passage = |p| PassageRecord {
        xc: xc.clone(),
        sifs: (0..size.cracks).map(|tip| xc.iter().map(|&x| sif(x, tip, p)).collect()).collect(),
        fluid: Vec::new(),
        kiii: Vec::new(),
        wheel: Vec::new(),
    };
    let cycles = |n: usize| 4.1e5 * (1.0 - 0.9f64.powi(n as i32));
    let tips = now.iter().enumerate().map(|(i, crack)| tip_record(i, crack, step, is_last)).collect();
    let record = StepRecord {
        step,
        tips,
        other_wheels: Vec::new(),
        other_faces: Vec::new(),
        passages: vec![passage(0), passage(1)],
        faces: faces(size, &now, &xc),
        fields: step.is_multiple_of(2).then(|| fields(step)),
        load_cycles: cycles(step),
        unfelt_opening: 0.0,
        cycles_error: 0.0,
        removed: 0.0,
        dofs: 30_000 + step,
        counts: SolverCounts {
            passages: 2,
            substeps: 300 + step,
            solves: 700 + step,
            iterations: 3 * (700 + step),
            iterations_max: 9,
            complementarity_max: 1e-11,
        },
        times: PhaseTimes {
            body_s: 0.5,
            parts: BodyTimes { condensation_s: 0.25, ..BodyTimes::default() },
            contact_s: 1.25,
            growth_s: 0.03125,
        },
        warnings: near_ties(step),
        pop_in_test: None,
        pieces: spalls(step),
        stop: is_last.then_some(RunStop::StepsDone),
        geometry: geometry(size, now),
    };
    let state = GrowthState {
        step: step + 1,
        counted: step + 1,
        geometry: geometry(size, cracks(size, if is_last { step } else { step + 1 })),
        interval: None,
        earlier: None,
        course: Default::default(),
        worn: Default::default(),
        tested_k1: 0.0,
        load_cycles: cycles(if is_last { step } else { step + 1 }),
        ended: record.stop,
    };
    (record, state)
}

fn geometry(size: Size, cracks: Vec<Crack>) -> Geometry {
    Geometry::Plane(PlaneGeometry {
        cracks,
        junctions: Vec::new(),
        break_outs: Vec::new(),
        stopped: vec![vec![None]; size.cracks],
        deferred: vec![vec![DeferredGrowth::default()]; size.cracks],
        courses: vec![vec![Default::default()]; size.cracks],
    })
}

/// The record of a step of a mix, whose second wheel has every other position of the first one and
/// half of its K and its pressure on the faces; the state after it is that of [`step`].
pub fn mixed_step(size: Size, n: usize) -> (StepRecord, GrowthState) {
    let (mut record, state) = step(size, n);
    let half = |passage: &PassageRecord| PassageRecord {
        xc: passage.xc.iter().copied().step_by(2).collect(),
        sifs: passage
            .sifs
            .iter()
            .map(|sifs| sifs.iter().step_by(2).map(|k| Sif { ki: 0.5 * k.ki, kii: 0.5 * k.kii }).collect())
            .collect(),
        ..passage.clone()
    };
    record.tips.iter_mut().for_each(|tip| tip.shares = WheelShares::from_values(&[0.4, 0.6]));
    record.other_wheels = vec![record.passages.iter().map(half).collect()];
    if n == 0 || record.stop.is_some() {
        let halved = |state: &FaceState| FaceState { s22: 0.5 * state.s22, ..*state };
        let states = record.faces.states.iter().step_by(2);
        record.other_faces = vec![FaceRecord {
            states: states.map(|states| states.iter().map(halved).collect()).collect(),
            ..record.faces.clone()
        }];
    }
    (record, state)
}

/// One triangle and one line at two positions.
fn fields(step: usize) -> FieldRecord {
    let points = vec![Vec2::new(0.0, 0.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)];
    let line = FieldLine { face: Face::Plus, ends: [0, 2], tractions: [[(0, 1.0), (1, 0.0)]; 2] };
    let grid = FieldGrid {
        inside: points.clone(),
        triangles: vec![[0, 1, 2]],
        lines: vec![line],
        quads: Vec::new(),
        points,
    };
    let snapshot = |position: usize| FieldSnapshot {
        position,
        xc: -3.0,
        displacement: vec![Vec2::new(1e-3 * step as f64, 0.1 * position as f64); 3],
        stress: vec![Stress { xx: -100.0 / 3.0, ..Stress::ZERO }; 3],
        traction: vec![Vec2::new(0.0, 5.0); 3],
    };
    FieldRecord { snapshots: vec![snapshot(10), snapshot(20)], grid }
}

fn near_ties(step: usize) -> Vec<Warning> {
    let text = "the rival direction grows 0.99 times as fast".to_owned();
    if step == 1 {
        vec![Warning { step, kind: WarningKind::NearTie, text, severity: None }]
    } else {
        Vec::new()
    }
}

/// A triangle above the first crack.
fn spalls(step: usize) -> Vec<Piece> {
    let outline = vec![Vec2::new(0.0, 0.0), Vec2::new(4.0, -1.0), Vec2::new(4.5, 0.0)];
    let spall = Piece {
        kind: PieceKind::Spall,
        step,
        crack: 0,
        outline,
        area: 2.25,
        thickness: 1.0,
        cause: PieceCause::Growth,
    };
    if step == 2 { vec![spall] } else { Vec::new() }
}

fn tip_record(i: usize, crack: &Crack, step: usize, is_last: bool) -> TipRecord {
    let place: Vec2 = crack.tip(End::Last);
    TipRecord {
        tip: CrackTip { crack: i, tip: 0, end: End::Last },
        x: place.x,
        y: place.y,
        length: crack.length(),
        ki_max: 280.0 + step as f64,
        delta_ki: 280.0 + step as f64,
        delta_kii: 190.0 / 3.0,
        delta_keq: 300.0,
        largest_k1: None,
        kink: (step != 3).then_some(-2f64.to_radians()),
        increment: if is_last { 0.0 } else { 0.04 * crack.length() / (1.0 + i as f64) },
        rate: 4e-6 / (1.0 + i as f64),
        stop: None,
        shares: Default::default(),
        mouth_sine: Some(0.5),
        opened_by: 0,
        toughness_ratio: 1.0,
        geometry: TipGeometry::Plane(PlaneTip {
            secondary: (step == 1).then_some(65f64.to_radians()),
            secondary_ratio: (step == 1).then_some(0.99),
            ..PlaneTip::default()
        }),
    }
}

fn faces(size: Size, cracks: &[Crack], xc: &[f64]) -> FaceRecord {
    let mut points = Vec::new();
    for (i, crack) in cracks.iter().enumerate() {
        let length = crack.length();
        for j in 0..size.face_points {
            let s = length * (j as f64 + 0.5) / size.face_points as f64;
            let (position, tangent) = (Vec2::default(), Vec2::unit(0.0));
            points.push(FacePoint {
                crack: i,
                segment: usize::from(s > 6.0),
                s,
                position,
                tangent,
                weight: 1.0,
            });
        }
    }
    let state = |x: f64, s: f64| {
        let u = (x - 0.9 * s) / HALF_WIDTH;
        if u < -1.0 && u > -2.2 {
            let opening = -1e-3 * (u + 1.0) * (u + 2.2);
            return FaceState { opening, slip: 1e-4 * s, s22: 0.0, s12: 0.0, status: FaceStatus::Open };
        }
        let s22 = -400.0 * (-u * u).exp() - 7.0 / (1.0 + u * u);
        let status = if (u - 0.2).abs() < 0.8 { FaceStatus::Slip } else { FaceStatus::Stick };
        let s12 = if status == FaceStatus::Slip { -0.5 * s22 } else { 0.3 * s22 * u.tanh() };
        FaceState { opening: 0.0, slip: 2e-3 * u.tanh() / (1.0 + s), s22, s12, status }
    };
    let states = xc.iter().map(|&x| points.iter().map(|p| state(x, p.s)).collect()).collect();
    FaceRecord { points, states, across: None, surface: Vec::new() }
}

/// Computes the steps from `from` to `to` (exclusive) into `recorder`.
pub fn record_steps(recorder: &mut Recorder, size: Size, from: usize, to: usize) -> Result<(), OutputError> {
    for n in from..to {
        let (record, state) = step(size, n);
        recorder.record(&record, &state)?;
    }
    Ok(())
}
