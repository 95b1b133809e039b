//! Representatives of the wheels of a table: groups by their passages over a coarse crack.

use super::coarse_crack::{CoarseWheel, coarse_histories, coarse_line, coarse_rate};
use super::coarse_front::{CoarseFront, FrontHistory, coarse_wheel};
use railcrack::body::BodyEngine;
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::DislocationEngine;
use railcrack::fatigue::GrowthLaw;
use railcrack::fracture::{Sif, SifHistory};
use railcrack::growth::FrontShape;
use railcrack::load::{Contact, Travel};
use railcrack::material::IsotropicElastic;
use railcrack::traffic::{Grouped, Groups, OpenCrack};
use railcrack_case::{Case, TabledWheel, WheelGroups, WheelTable};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// The wheels of `table` in `case` in groups, at most as many as it accepts, by their passages over
/// the first crack. Where a coarse passage does not converge, the open crack takes its place.
pub(super) fn grouped(case: &Case, table: &WheelTable) -> WheelGroups {
    let contact = |i: usize| case.wheels.get(table.first + i)?.wheel.contact();
    let loaded: Vec<usize> = (0..table.wheels.len()).filter(|i| contact(*i).is_some()).collect();
    let share = |i: usize| table.wheels[i].share;
    let alone = |i: &usize| Grouped { share: share(*i), effect: vec![*i as f64], rate: 1.0 };
    let effects = (loaded.len() > table.most).then(|| effects(case, table, &loaded)).flatten();
    let grouped = |(i, (effect, rate)): (&usize, (Vec<f64>, f64))| Grouped {
        share: share(*i),
        effect,
        rate: if rate.is_finite() { rate } else { f64::MAX.sqrt() },
    };
    let all: Vec<Grouped> = match effects {
        Some(effects) => loaded.iter().zip(effects).map(grouped).collect(),
        None => loaded.iter().map(alone).collect(),
    };
    let groups = Groups::of(&all, table.most);
    let mut group_of = vec![None; table.wheels.len()];
    loaded.iter().zip(&groups.group_of).for_each(|(wheel, group)| group_of[*wheel] = Some(*group));
    WheelGroups {
        representatives: groups.representatives.iter().map(|own| loaded[*own]).collect(),
        group_of,
        error: groups.error,
    }
}

/// Effects of the wheels `loaded` of `table` on the first crack; none where it has no body.
fn effects(case: &Case, table: &WheelTable, loaded: &[usize]) -> Option<Effects> {
    let friction = *case.crack_friction.first()?;
    let (steel, law, travel) = (&case.steel, &case.growth.law, table.travel);
    if let Some(space) = case.space() {
        let shape = FrontShape { deviation: None, ..*space.shapes.first()? };
        let wheels: Vec<&TabledWheel> = loaded.iter().map(|i| &table.wheels[*i]).collect();
        return by_coarse_front(&wheels, (&shape, friction), steel, travel, law);
    }
    if table.is_whole {
        let wheels: Vec<CoarseWheel> =
            loaded.iter().map(|i| coarse_wheel(&table.wheels[*i], travel, table.lateral, steel)).collect();
        return by_coarse_crack(&wheels, (&case.cracks, friction), steel, travel, law);
    }
    let contact = |i: &usize| case.wheels[table.first + i].wheel.contact();
    let contacts: Vec<&Contact> = loaded.iter().filter_map(contact).collect();
    let lines: Option<Vec<CoarseWheel>> = contacts.iter().map(|own| coarse_line(own, steel)).collect();
    lines
        .and_then(|lines| by_coarse_crack(&lines, (&case.cracks, friction), steel, travel, law))
        .or_else(|| by_open_crack(&contacts, (&case.cracks, friction), steel, law))
}

/// History of K and rate of each wheel.
type Effects = Vec<(Vec<f64>, f64)>;

fn flat<'a>(samples: impl Iterator<Item = &'a Sif>) -> Vec<f64> {
    samples.flat_map(|k| [k.ki, k.kii]).collect()
}

/// Rates by `law`; where it gives none, by that of rail steel, so that wheels still differ.
fn rates<H>(histories: &[H], law: &GrowthLaw, rate: impl Fn(&H, &GrowthLaw) -> f64) -> Vec<f64> {
    let all = |law: &GrowthLaw| histories.iter().map(|own| rate(own, law)).collect::<Vec<f64>>();
    let rated = all(law);
    if rated.iter().all(|rate| *rate == 0.0) { all(&GrowthLaw::RAIL_STEEL) } else { rated }
}

fn by_coarse_crack(
    wheels: &[CoarseWheel],
    crack: (&CrackNetwork, f64),
    steel: &IsotropicElastic,
    travel: Travel,
    law: &GrowthLaw,
) -> Option<Effects> {
    let histories = coarse_histories(wheels, crack, steel, travel)?;
    let rated = rates(&histories, law, |own, law| coarse_rate(own, law));
    let effect = |tips: &Vec<SifHistory>| flat(tips.iter().flat_map(|tip| &tip.samples));
    Some(histories.iter().map(effect).zip(rated).collect())
}

fn by_coarse_front(
    wheels: &[&TabledWheel],
    (shape, friction): (&FrontShape, f64),
    steel: &IsotropicElastic,
    travel: Travel,
    law: &GrowthLaw,
) -> Option<Effects> {
    let front = CoarseFront::new(shape, friction, steel)?;
    let histories = front.histories(wheels, travel, 0.0);
    let rated = rates(&histories, law, |own, law| front.rate(own, law));
    Some(histories.iter().map(FrontHistory::flat).zip(rated).collect())
}

fn by_open_crack(
    contacts: &[&Contact],
    (network, friction): (&CrackNetwork, f64),
    steel: &IsotropicElastic,
    law: &GrowthLaw,
) -> Option<Effects> {
    let widths: Vec<f64> = contacts.iter().map(|contact| contact.half_width()).collect();
    let open = open_crack(&widths, network, friction, steel)?;
    let histories: Vec<Vec<Sif>> = contacts.par_iter().map(|contact| open.history(contact)).collect();
    let rated = rates(&histories, law, |own, law| open.rate(own, law));
    Some(histories.iter().map(|own| flat(own.iter())).zip(rated).collect())
}

/// Smallest half-width of the table of the open crack over the largest one: strips at the edge of a
/// patch, shorter than that, load it by next to nothing.
const SHORTEST: f64 = 0.05;

/// The first crack, open, under contacts of the half-widths `widths` (mm); `friction` is that of
/// its faces.
pub(super) fn open_crack(
    widths: &[f64],
    network: &CrackNetwork,
    friction: f64,
    steel: &IsotropicElastic,
) -> Option<OpenCrack> {
    let first: Crack = network.cracks().first()?.clone();
    let mouth = first.points()[0].x;
    let body = DislocationEngine::new(*steel).body(&first.into()).ok()?;
    let most = widths.iter().copied().fold(0.0, f64::max);
    let least = widths.iter().copied().fold(most, f64::min).max(SHORTEST * most);
    (most > 0.0).then(|| OpenCrack::new(&body, [mouth, mouth], [least, most], steel.poisson(), friction))
}
