//! Representatives of the wheels of a table: groups by an open crack.

use super::wheel_table::TabledWheel;
use railcrack::body::BodyEngine;
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::DislocationEngine;
use railcrack::fatigue::GrowthLaw;
use railcrack::fracture::Sif;
use railcrack::load::Contact;
use railcrack::material::IsotropicElastic;
use railcrack::traffic::{Grouped, Groups, OpenCrack};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Groups of the wheels `loaded`, at most `most`, by what drives the first crack; `friction` is
/// that of its faces.
pub(super) fn group(
    wheels: &[TabledWheel],
    loaded: &[usize],
    most: usize,
    (network, friction): (&CrackNetwork, f64),
    (steel, law): (&IsotropicElastic, &GrowthLaw),
) -> Groups {
    let alone = |i: &usize| Grouped { share: wheels[*i].share, effect: vec![*i as f64], rate: 1.0 };
    if loaded.len() <= most {
        return Groups::of(&loaded.iter().map(alone).collect::<Vec<_>>(), most);
    }
    let contacts: Vec<&Contact> = loaded.iter().filter_map(|i| wheels[*i].contact.as_ref()).collect();
    let widths: Vec<f64> = contacts.iter().map(|contact| contact.half_width()).collect();
    let Some(open) = open_crack(&widths, network, friction, steel) else {
        return Groups::of(&loaded.iter().map(alone).collect::<Vec<_>>(), most);
    };
    let histories: Vec<Vec<Sif>> = contacts.par_iter().map(|contact| open.history(contact)).collect();
    let rates = |law: &GrowthLaw| histories.iter().map(|own| open.rate(own, law)).collect::<Vec<f64>>();
    let mut rated = rates(law);
    if rated.iter().all(|rate| *rate == 0.0) {
        rated = rates(&GrowthLaw::RAIL_STEEL);
    }
    let grouped = |((i, history), rate): ((&usize, &Vec<Sif>), f64)| Grouped {
        share: wheels[*i].share,
        effect: history.iter().flat_map(|k| [k.ki, k.kii]).collect(),
        rate: if rate.is_finite() { rate } else { f64::MAX.sqrt() },
    };
    let all: Vec<Grouped> = loaded.iter().zip(&histories).zip(rated).map(grouped).collect();
    Groups::of(&all, most)
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
