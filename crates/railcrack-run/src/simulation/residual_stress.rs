//! The residual stress of a run: the stages before its first step.

use super::error::RunError;
use super::job::Stage;
use super::observer::RunObserver;
use super::recorder::Recorder;
use super::rolling::{pass_text, roll};
use crate::csv::{ResidualRow, read_table};
use crate::disk::files::{PLASTIC_FILE, ROLLED_FOLDER, SHAKEDOWN_FILE};
use crate::disk::own_folder;
use crate::error::OutputError;
use crate::log::{PlasticOrigin, ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
use crate::run_folder::Existing;
use crate::setup::{
    CarriedStress, HeaviestWheel, LayeredStress, PreparedRun, Projection, Release, RolledStress,
    SectionStress, SharedRail, WheelBounds,
};
use crate::shakedown::{LayerRow, SectionRow, ShakedownSummary};
use railcrack::interruption::Interruption;
use railcrack::math::{Stress, Tensor, Vec2};
use railcrack::residual::PlasticField;
use railcrack::shakedown::RailState;
use railcrack::stopwatch::Stopwatch;
use railcrack_case::{Case, Engine, PlaneEngine, PlasticSource};
use railcrack_vtu::read_vtu;
use std::path::Path;
use std::sync::Arc;

/// Residual stress of a run, for its folder.
#[derive(Debug, Clone)]
pub struct Residual {
    /// `residual.csv`.
    pub rows: Vec<ResidualRow>,
    /// The rest.
    pub summary: ResidualSummary,
}

impl Residual {
    /// Writes it and reports its remarks.
    ///
    /// Errors: a number that is not finite; the system refuses.
    pub fn record(self, recorder: &mut Recorder, observer: &dyn RunObserver) -> Result<(), OutputError> {
        self.announce(observer);
        recorder.residual(&self.rows, self.summary)
    }

    /// Reports its remarks.
    pub(super) fn announce(&self, observer: &dyn RunObserver) {
        for note in &self.summary.notes {
            observer.note(note);
        }
    }
}

/// Computes the plastic state of the rolled rail if the case requires it, and balances the stress
/// of the rail; neither, and no residual stress to record, where the rail of `stage` carries it.
///
/// Errors: the plastic state cannot be computed, written or read back; the residual stress cannot
/// be balanced.
pub(super) fn prepare<'a>(
    case: &'a Case,
    stage: &Stage<'a>,
) -> Result<(PreparedRun<'a>, Option<Residual>), RunError> {
    if stage.shared.is_some_and(|shared| shared.carried().is_some()) {
        return Ok((PreparedRun::sharing(case, None, stage.shared)?, None));
    }
    let started = Stopwatch::start();
    let rolled = match case.plastic_stress() {
        Some(PlasticSource::Rolled) => Some(rolled_state(case, stage)?),
        _ => None,
    };
    if case.plastic_stress().is_some() {
        stage.observer.stage("projecting and balancing the plastic stress");
    }
    let prepared = PreparedRun::sharing(case, rolled.as_ref().map(|(stress, _)| stress), stage.shared)?;
    let carried = prepared.residual();
    let Some(rows) = rows(case, carried) else { return Ok((prepared, None)) };
    let mut notes = Vec::new();
    let rolled = rolled.map(|(_, summary)| rolled_summary(case, &summary, &mut notes));
    notes.extend(carried.projection.and_then(|projection| narrow(case, &projection)));
    notes.extend(carried.release.map(release_note));
    let summary = ResidualSummary {
        balanced_profile: case.residual_stress.as_ref().map(|file| file.given_name().into()),
        plastic_source: case.plastic_stress().map(origin),
        rolled,
        projection: carried.projection.map(|projection| ProjectionSummary {
            nodes_norm_ratio: projection.recovery.map(|loss| loss.norm_ratio),
            nodes_difference: projection.recovery.map(|loss| loss.difference),
            mesh_norm_ratio: projection.loss.norm_ratio,
            mesh_difference: projection.loss.difference,
            norm_mpa_mm: projection.loss.norm,
        }),
        release: carried.release.map(|release| ReleaseSummary {
            depth_mm: release.depth,
            held_sxx_mpa: release.held,
            free_sxx_mpa: release.free,
            carried: release.carried,
        }),
        wall_s: started.seconds(),
        notes,
    };
    Ok((prepared, Some(Residual { rows, summary })))
}

/// The rail of `case` with the plastic stress that it carries, for further runs that `engine`
/// computes from `stage`; none without such a stress, or where it is shared already.
///
/// Errors: an interruption.
pub(super) fn carrying_rail(
    case: &Case,
    engine: Engine,
    stage: &Stage,
) -> Result<Option<SharedRail>, RunError> {
    let is_known = stage.shared.is_some_and(|shared| shared.carried().is_some());
    let is_quick = engine == Engine::Plane(PlaneEngine::Dislocation);
    if is_known || !is_quick || case.plastic_stress().is_none() {
        return Ok(None);
    }
    match prepare(case, stage) {
        Err(error) if error.is_interruption() => Err(error),
        // The runs report the error.
        prepared => Ok(prepared.ok().map(|(prepared, _)| prepared.carrying_rail())),
    }
}

fn origin(source: &PlasticSource) -> PlasticOrigin {
    match source {
        PlasticSource::Field(_) => PlasticOrigin::Field,
        PlasticSource::Profile(_) => PlasticOrigin::Profile,
        PlasticSource::Rolled => PlasticOrigin::Rolled,
    }
}

/// The stress on the middle line; none where the rail carries none.
fn rows(case: &Case, carried: &CarriedStress) -> Option<Vec<ResidualRow>> {
    if carried.field.is_none() && carried.standing.is_none() {
        return None;
    }
    let at = |&depth: &f64| {
        let field = carried.field.as_ref();
        let own = field.map_or(Stress::ZERO, |field| field.stress(Vec2::new(case.rail.centre, -depth)));
        let standing = carried.standing.as_ref();
        let [xx, yy, zz, _, xz, _] = standing.map_or([0.0; 6], |field| field.stress([0.0, 0.0, depth]));
        ResidualRow { depth, stress: own + Stress { xx, yy: zz, zz: yy, xy: -xz } }
    };
    Some(carried.depths.iter().map(at).collect())
}

/// The stabilised state of the rail, in a folder of its own: computed, or taken from there by a run
/// that goes on.
fn rolled_state(case: &Case, stage: &Stage) -> Result<(RolledStress, ShakedownSummary), RunError> {
    let folder = own_folder(stage.folder, ROLLED_FOLDER)?;
    let asked = || stage.observer.interrupted();
    let stored = match stage.state {
        Some(_) => stored(&folder),
        None => None,
    };
    let summary = match stored {
        Some(summary) => summary,
        None => roll(
            case,
            0.0,
            (&folder, Existing::Replace),
            stage.presentation,
            Interruption::when(&asked),
            |pass| {
                stage.observer.stage(&format!("plastic state, {}", pass_text(pass)));
            },
        )?,
    };
    if summary.grid.is_some() && case.space().is_some() {
        let rows: Vec<SectionRow> = read_table(&folder)?;
        let places: Vec<(f64, f64, Tensor)> =
            rows.iter().map(|row| (row.lateral, row.depth, row.stress)).collect();
        let damaged = || RunError::Rolled("section.csv has no rows of the same layers".to_owned());
        let section = SectionStress::new(&places).ok_or_else(damaged)?;
        return Ok((RolledStress::Across(Arc::new(section)), summary));
    }
    if summary.grid.is_some() {
        let layers: Vec<LayerRow> = read_table(&folder)?;
        let rows = layers.iter().map(|layer| (layer.depth, layer.stress)).collect();
        return Ok((RolledStress::Balanced(LayeredStress::new(rows)), summary));
    }
    // As if a case named this file.
    let path = folder.join(PLASTIC_FILE);
    let grid = read_vtu(&path).map_err(|error| RunError::Rolled(error.to_string()))?;
    let field = PlasticField::from_grid(&grid).map_err(|error| RunError::Rolled(error.to_string()))?;
    Ok((RolledStress::Plastic(field), summary))
}

/// The state that stands in `folder`; none where it is not whole.
fn stored(folder: &Path) -> Option<ShakedownSummary> {
    // Written last.
    let text = std::fs::read_to_string(folder.join(SHAKEDOWN_FILE)).ok()?;
    serde_json::from_str(&text).ok()
}

fn rolled_summary(case: &Case, summary: &ShakedownSummary, notes: &mut Vec<String>) -> RolledSummary {
    if summary.state == RailState::PlasticShakedown {
        notes.push(
            "plastic shakedown: the rail yields in every passage, and the crack is loaded by the stress between passages".into(),
        );
    }
    notes.extend(summary.warnings.iter().cloned());
    RolledSummary {
        folder: ROLLED_FOLDER.into(),
        state: summary.state,
        passes: summary.passes,
        p0_over_k: summary.p0_over_k,
        wheel: case.is_mix().then(|| case.wheels[HeaviestWheel::of_case(case).wheel].name.clone()),
    }
}

/// A mesh that ends within the rail.
fn narrow(case: &Case, projection: &Projection) -> Option<String> {
    let (left, right, depth) = projection.extent;
    if !matches!(case.plastic_stress(), Some(PlasticSource::Field(_))) {
        return None;
    }
    let (from, to) = case.rail.ends();
    (left > from || right < to).then(|| {
        format!(
            "the plastic stress is given from x = {left} to {right} mm and to a depth of {depth} mm: beyond these ends it is continued unchanged, below this depth it is zero"
        )
    })
}

fn release_note(release: Release) -> String {
    let carried = if release.carried {
        "the run uses the released stress"
    } else {
        "it is given as balanced, and the run uses it unchanged"
    };
    format!(
        "the free sides of the block release the residual stress: at depth {:.3} mm on the middle line sxx = {:.2} MPa becomes \
         {:.2} MPa; {carried}",
        release.depth, release.held, release.free
    )
}

/// A wheel that causes yielding in a rail whose plastic stress the run ignores: of a mix the
/// heaviest.
pub fn plastic_stress_left_out(case: &Case) -> Option<String> {
    if case.plastic_stress().is_some() || case.residual_stress.is_some() {
        return None;
    }
    let number = HeaviestWheel::of_case(case).wheel;
    let heaviest = &case.wheels[number];
    let ratio = heaviest.wheel.contact()?.peak_pressure() / case.shakedown.hardening.shear_yield_stress();
    let first = WheelBounds::of(case, number)?.first_yield.ratio;
    let under = match case.is_mix() {
        true => format!(" under the wheel \"{}\"", heaviest.name),
        false => String::new(),
    };
    (ratio > first).then(|| {
        format!(
            "p0 / k = {ratio:.3}{under} is beyond first yield at {first:.3}, but the run ignores the plastic stress: add an empty [plastic_stress] section to compute it first"
        )
    })
}
