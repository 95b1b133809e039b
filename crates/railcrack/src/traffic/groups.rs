//! Groups of similar wheels, each with a representative.

/// A wheel to be grouped.
#[derive(Debug, Clone, PartialEq)]
pub struct Grouped {
    /// Share of the axles.
    pub share: f64,
    /// Numbers that describe its effect on the crack, in one unit, as many for every wheel.
    pub effect: Vec<f64>,
    /// Growth rate that the surrogate gives it.
    pub rate: f64,
}

/// Wheels in groups. A representative stands for all wheels of its group with their shares.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// The representative of each wheel: an index into `representatives`.
    pub group_of: Vec<usize>,
    /// The representatives, indices of wheels: in order where every wheel has its own group,
    /// otherwise those whose groups grow the crack most first.
    pub representatives: Vec<usize>,
    /// The share of each group.
    pub shares: Vec<f64>,
    /// Σ s r of the representatives over that of all wheels, less 1: the error of the mean rate by
    /// the surrogate.
    pub error: f64,
}

/// Rounds of reassignment: groups of a thousand wheels settle in fewer.
const ROUNDS: usize = 12;

/// Wheels nearest to the middle of a group from which its representative is chosen.
const CANDIDATES: usize = 3;

/// Rounds in which representatives are exchanged for others of their group to meet the mean rate.
const EXCHANGES: usize = 4;

impl Groups {
    /// At most `most` groups of `wheels`: centres by weighted distance (the farthest next), then
    /// Lloyd's rounds, and of the wheels nearest to each centre the one with which the mean rate is
    /// met best. No chance is involved.
    #[must_use]
    pub fn of(wheels: &[Grouped], most: usize) -> Self {
        let count = wheels.len();
        let total: f64 = wheels.iter().map(|wheel| wheel.share * wheel.rate).sum();
        if count <= most.max(1) {
            return Self {
                group_of: (0..count).collect(),
                representatives: (0..count).collect(),
                shares: wheels.iter().map(|wheel| wheel.share).collect(),
                error: 0.0,
            };
        }
        let weights = weights(wheels);
        let mut centres = first_centres(wheels, &weights, most.max(1));
        let mut group_of = vec![0; count];
        for _ in 0..ROUNDS {
            let before = group_of.clone();
            for (own, wheel) in group_of.iter_mut().zip(wheels) {
                *own = nearest(&centres, &wheel.effect);
            }
            if before == group_of {
                break;
            }
            move_centres(&mut centres, wheels, &weights, &group_of);
        }
        let chosen = choose(wheels, &centres, &group_of);
        let growth = |group: usize| {
            let own = group_of.iter().zip(wheels).filter(|(own, _)| **own == group);
            own.map(|(_, wheel)| wheel.share * wheel.rate).sum::<f64>()
        };
        let mut order: Vec<(usize, usize, f64)> = chosen
            .iter()
            .enumerate()
            .filter_map(|(group, wheel)| Some((group, (*wheel)?, growth(group))))
            .collect();
        order.sort_by(|a, b| b.2.total_cmp(&a.2).then(a.1.cmp(&b.1)));
        let representatives: Vec<usize> = order.iter().map(|(_, wheel, _)| *wheel).collect();
        let mut place = vec![0; chosen.len()];
        order.iter().enumerate().for_each(|(i, (group, ..))| place[*group] = i);
        let group_of: Vec<usize> = group_of.iter().map(|group| place[*group]).collect();
        let mut shares = vec![0.0; representatives.len()];
        for (group, wheel) in group_of.iter().zip(wheels) {
            shares[*group] += wheel.share;
        }
        let met: f64 = representatives.iter().zip(&shares).map(|(i, share)| share * wheels[*i].rate).sum();
        let error = if total > 0.0 { met / total - 1.0 } else { 0.0 };
        Self { group_of, representatives, shares, error }
    }
}

/// The weight of each wheel: what it contributes to the growth, over its own size, since errors
/// count relative to it; a small part by share alone, so that wheels without growth also have a
/// place.
fn weights(wheels: &[Grouped]) -> Vec<f64> {
    let total: f64 = wheels.iter().map(|wheel| wheel.share * wheel.rate).sum();
    let largest = wheels.iter().map(|wheel| size2(&wheel.effect)).fold(f64::MIN_POSITIVE, f64::max);
    let weight = |wheel: &Grouped| {
        let growth = if total > 0.0 { wheel.share * wheel.rate / total } else { wheel.share };
        (growth + 1e-3 * wheel.share) / (size2(&wheel.effect) / largest + 1e-3)
    };
    wheels.iter().map(weight).collect()
}

fn size2(effect: &[f64]) -> f64 {
    effect.iter().map(|value| value * value).sum()
}

fn distance2(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

fn nearest(centres: &[Vec<f64>], effect: &[f64]) -> usize {
    let distances = centres.iter().map(|centre| distance2(centre, effect)).enumerate();
    distances.reduce(|best, next| if next.1 < best.1 { next } else { best }).map_or(0, |(group, _)| group)
}

/// The heaviest wheel, then again and again the one that is farthest from all centres by weight.
fn first_centres(wheels: &[Grouped], weights: &[f64], count: usize) -> Vec<Vec<f64>> {
    let largest = |of: &[f64]| {
        let all = of.iter().copied().enumerate();
        all.reduce(|best, next| if next.1 > best.1 { next } else { best }).map_or(0, |(i, _)| i)
    };
    let mut centres = vec![wheels[largest(weights)].effect.clone()];
    let mut away: Vec<f64> = wheels.iter().map(|wheel| distance2(&centres[0], &wheel.effect)).collect();
    while centres.len() < count {
        let weighted: Vec<f64> = away.iter().zip(weights).map(|(away, weight)| away * weight).collect();
        let next = largest(&weighted);
        if weighted[next] <= 0.0 {
            break;
        }
        centres.push(wheels[next].effect.clone());
        for (away, wheel) in away.iter_mut().zip(wheels) {
            *away = away.min(distance2(&wheels[next].effect, &wheel.effect));
        }
    }
    centres
}

fn move_centres(centres: &mut [Vec<f64>], wheels: &[Grouped], weights: &[f64], group_of: &[usize]) {
    for (group, centre) in centres.iter_mut().enumerate() {
        let mut sum = vec![0.0; centre.len()];
        let mut total = 0.0;
        for ((wheel, weight), _) in wheels.iter().zip(weights).zip(group_of).filter(|(_, own)| **own == group)
        {
            total += weight;
            sum.iter_mut().zip(&wheel.effect).for_each(|(sum, value)| *sum += weight * value);
        }
        if total > 0.0 {
            *centre = sum.iter().map(|sum| sum / total).collect();
        }
    }
}

/// The representative of each group; none of an empty one. Groups that grow most are served first,
/// and each choice makes up for the error of those before; then for that of all others.
fn choose(wheels: &[Grouped], centres: &[Vec<f64>], group_of: &[usize]) -> Vec<Option<usize>> {
    let mut groups: Vec<Candidates> =
        (0..centres.len()).map(|group| Candidates::of(wheels, &centres[group], group, group_of)).collect();
    groups.sort_by(|a, b| b.growth.total_cmp(&a.growth).then(a.group.cmp(&b.group)));
    let (mut chosen, mut error) = (vec![None; centres.len()], 0.0);
    for round in 0..=EXCHANGES {
        for own in &groups {
            let off = |i: usize| own.share * wheels[i].rate - own.growth;
            let others = error - if round == 0 { 0.0 } else { chosen[own.group].map_or(0.0, off) };
            let left = |i: usize| (others + off(i)).abs();
            let best = own.nearest.iter().copied().reduce(|a, b| if left(b) < left(a) { b } else { a });
            if let Some(best) = best {
                error = others + off(best);
                chosen[own.group] = Some(best);
            }
        }
    }
    chosen
}

/// The wheels that may represent a group.
struct Candidates {
    group: usize,
    /// Share of the axles of the group, and what it contributes to the growth.
    share: f64,
    growth: f64,
    /// The wheels nearest to its centre.
    nearest: Vec<usize>,
}

impl Candidates {
    fn of(wheels: &[Grouped], centre: &[f64], group: usize, group_of: &[usize]) -> Self {
        let members = || (0..wheels.len()).filter(|i| group_of[*i] == group);
        let mut near: Vec<(usize, f64)> =
            members().map(|i| (i, distance2(centre, &wheels[i].effect))).collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        near.truncate(CANDIDATES);
        Self {
            group,
            share: members().map(|i| wheels[i].share).sum(),
            growth: members().map(|i| wheels[i].share * wheels[i].rate).sum(),
            nearest: near.into_iter().map(|(i, _)| i).collect(),
        }
    }
}
