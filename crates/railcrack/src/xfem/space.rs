//! Enriched approximation space: enrichment functions and their supports.

use super::cuts::{CellPlace, Cuts, elements_at, join};
use crate::math::Vec2;
use crate::mesh::{Edge, NODES, QuadMesh};
use std::collections::{BTreeMap, BTreeSet};

/// An enrichment, with two unknowns.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Enrichment {
    /// The shape function of a node, restricted to one of the parts into which the cracks divide
    /// its support and in which the node itself does not lie: the shifted Heaviside function.
    /// Unknowns along x and y.
    Part {
        /// The node.
        node: usize,
        /// Regions (element, region) of the part.
        regions: Vec<(usize, usize)>,
    },
    /// The shape function of a node times the displacement fields of K_I and K_II = 1 MPa √mm at a
    /// tip, or at a kink as if it were a tip.
    Tip {
        /// Index of the tip or kink.
        tip: usize,
        /// The node.
        node: usize,
    },
}

/// A tip or kink, and the enrichment that each node of an element carries for it.
type TipFunctions = (usize, [Option<usize>; NODES]);

/// The enrichments of a mesh with cracks, ordered along the cracks from their first points, so that
/// the advance of a tip leaves the leading enrichments unchanged. Enrichment i has the unknowns 2 i
/// and 2 i + 1.
#[derive(Debug, Clone)]
pub(super) struct Space {
    pub enrichments: Vec<Enrichment>,
    /// (element, region, local node) → enrichment.
    parts: BTreeMap<(usize, usize), [Option<usize>; NODES]>,
    /// element → (tip, enrichments of the nodes).
    tips: BTreeMap<usize, Vec<TipFunctions>>,
    /// Elements with an enrichment, in increasing order.
    pub elements: Vec<usize>,
}

impl Space {
    /// The space of `cuts` with √r functions at the nodes within `radius[tip]` (mm) of each tip and
    /// of the elements that contain it. Elements that need cells are added to the cuts.
    pub(super) fn new(mesh: &QuadMesh, cuts: &mut Cuts, radius: &[f64]) -> Self {
        let mut enrichments = Vec::new();
        let mut parts: BTreeMap<(usize, usize), [Option<usize>; NODES]> = BTreeMap::new();
        let nodes: BTreeSet<usize> = cuts.elements.keys().flat_map(|&e| mesh.element(e).nodes).collect();
        for node in nodes {
            for regions in other_parts(mesh, cuts, node) {
                for &(e, region) in &regions {
                    let local = mesh.element(e).nodes.iter().position(|&n| n == node).expect("own element");
                    parts.entry((e, region)).or_insert([None; NODES])[local] = Some(enrichments.len());
                }
                enrichments.push(Enrichment::Part { node, regions });
            }
        }
        let mut tips: BTreeMap<usize, Vec<TipFunctions>> = BTreeMap::new();
        for (tip, &radius) in radius.iter().enumerate() {
            for node in tip_nodes(mesh, cuts, tip, radius) {
                for e in mesh.elements_of(node) {
                    let local = mesh.element(e).nodes.iter().position(|&n| n == node).expect("own element");
                    let list = tips.entry(e).or_default();
                    if list.last().is_none_or(|(t, _)| *t != tip) {
                        list.push((tip, [None; NODES]));
                    }
                    let last = list.len() - 1;
                    list[last].1[local] = Some(enrichments.len());
                }
                enrichments.push(Enrichment::Tip { tip, node });
            }
        }
        let tip_lists = tips.values_mut().flatten().map(|(_, list)| list);
        sort_along(mesh, cuts, &mut enrichments, parts.values_mut().chain(tip_lists));
        // A crack through a node touches two of its elements at that point only, and still
        // separates their functions.
        for e in parts.keys().map(|&(e, _)| e).chain(tips.keys().copied()) {
            cuts.include(mesh, e);
        }
        let mut elements: Vec<usize> = parts.keys().map(|&(e, _)| e).chain(tips.keys().copied()).collect();
        elements.sort_unstable();
        elements.dedup();
        Self { enrichments, parts, tips, elements }
    }

    /// Number of enriched unknowns.
    pub(super) fn unknowns(&self) -> usize {
        2 * self.enrichments.len()
    }

    /// Per local node, the enrichment with support in a cell.
    pub(super) fn parts_in(&self, cuts: &Cuts, place: CellPlace) -> [Option<usize>; NODES] {
        self.parts.get(&(place.element, cuts.region(place))).copied().unwrap_or([None; NODES])
    }

    /// The tips with functions in an element, each with the enrichments of its nodes.
    pub(super) fn tips_in(&self, element: usize) -> &[TipFunctions] {
        self.tips.get(&element).map_or(&[], Vec::as_slice)
    }
}

/// Sorts enrichments by the arc length at which they are nearest to a crack, and renumbers them in
/// `lists`.
fn sort_along<'a>(
    mesh: &QuadMesh,
    cuts: &Cuts,
    enrichments: &mut Vec<Enrichment>,
    lists: impl Iterator<Item = &'a mut [Option<usize>; NODES]>,
) {
    let nearest = |at: Vec2| {
        let all = cuts.paths.iter().map(|path| path.nearest(at));
        all.fold((f64::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a }).1
    };
    let arc: Vec<f64> = enrichments
        .iter()
        .map(|enrichment| match enrichment {
            Enrichment::Part { node, .. } => nearest(mesh.node_position(*node)),
            Enrichment::Tip { tip, .. } => nearest(cuts.poles[*tip].position()),
        })
        .collect();
    let mut sorted: Vec<usize> = (0..arc.len()).collect();
    sorted.sort_by(|&a, &b| arc[a].total_cmp(&arc[b]));
    let mut place = vec![0; arc.len()];
    sorted.iter().enumerate().for_each(|(at, &before)| place[before] = at);
    for entry in lists.flatten().flatten() {
        *entry = place[*entry];
    }
    *enrichments = sorted.iter().map(|&before| enrichments[before].clone()).collect();
}

/// The nodes that carry the functions of a tip or kink.
fn tip_nodes(mesh: &QuadMesh, cuts: &Cuts, tip: usize, radius: f64) -> BTreeSet<usize> {
    let at = cuts.poles[tip].position();
    let mut nodes = BTreeSet::new();
    for e in elements_at(mesh, at) {
        nodes.extend(mesh.element(e).nodes);
    }
    let reach = Vec2::new(radius, radius);
    let (columns, rows) = mesh.places_meeting(at - reach, at + reach);
    for row in rows {
        for column in columns.clone() {
            let corners = mesh.element(row * mesh.columns() + column).nodes;
            nodes.extend(corners.iter().filter(|&&n| (mesh.node_position(n) - at).length() <= radius));
        }
    }
    nodes
}

/// The parts of the support of `node` that are separated from the node, each as regions (element,
/// region).
fn other_parts(mesh: &QuadMesh, cuts: &Cuts, node: usize) -> Vec<Vec<(usize, usize)>> {
    let patch = mesh.elements_of(node);
    let members: Vec<(usize, usize)> =
        patch.iter().flat_map(|&e| (0..cuts.regions(e)).map(move |r| (e, r))).collect();
    if members.len() == patch.len() && patch.len() == 1 {
        return Vec::new();
    }
    let mut names: Vec<usize> = (0..members.len()).collect();
    let index =
        |e: usize, r: usize| members.iter().position(|&m| m == (e, r)).expect("a member of the patch");
    for &e in &patch {
        for side in [Edge::Top, Edge::Right] {
            let Some(other) = mesh.neighbour(e, side).filter(|other| patch.contains(other)) else { continue };
            for (own, beyond) in cuts.joined(mesh, e, side) {
                join(&mut names, index(e, own), index(other, beyond));
            }
        }
    }
    let first = names[0];
    if names.iter().all(|&name| name == first) {
        return Vec::new();
    }
    let own = own_part(mesh, cuts, node, &members, &names);
    let mut others: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
    for (&member, &name) in members.iter().zip(&names) {
        if name != own {
            others.entry(name).or_default().push(member);
        }
    }
    others.into_values().collect()
}

/// The label of the part in which the node lies; the first of several if a crack passes through the
/// node.
fn own_part(mesh: &QuadMesh, cuts: &Cuts, node: usize, members: &[(usize, usize)], names: &[usize]) -> usize {
    let at = mesh.node_position(node);
    for (&(e, region), &name) in members.iter().zip(names) {
        let Some(cut) = cuts.elements.get(&e) else { return name };
        let touches = cut.sides.iter().any(|piece| {
            let along = super::cuts::along_side(piece.side, at);
            let across = match piece.side {
                Edge::Bottom => at.y == cut.element.lower.y,
                Edge::Top => at.y == cut.element.upper.y,
                Edge::Left => at.x == cut.element.lower.x,
                Edge::Right => at.x == cut.element.upper.x,
            };
            across && piece.from <= along && along <= piece.to && cut.region[piece.cell] == region
        });
        if touches {
            return name;
        }
    }
    names[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::{Crack, CrackNetwork};
    use crate::math::RailBox;
    use crate::xfem::refined_region::{MeshSettings, RefinedRegion};

    #[test]
    fn supports_cut_in_two_have_one_other_part() {
        for degrees in [75.0f64, 60.0, 30.0, 15.0] {
            let network: CrackNetwork =
                Crack::surface_breaking(0.0, 6.0, degrees.to_radians()).unwrap().into();
            let refined =
                RefinedRegion::new(&network, MeshSettings { element_size: 0.2, expected_growth: 2.67 });
            let mesh = refined.mesh(RailBox { width: 6000.0, depth: 3000.0, centre: 0.0 }).unwrap();
            let mut cuts = Cuts::new(&mesh, &network);
            let held: Vec<usize> =
                cuts.elements.iter().filter(|(_, c)| c.regions > 1).map(|(e, _)| *e).collect();
            let space = Space::new(&mesh, &mut cuts, &[0.0]);
            let tip = cuts.tips[0].position();
            for e in held {
                for node in mesh.element(e).nodes {
                    let patch = mesh.elements_of(node);
                    if patch.iter().any(|&e| elements_at(&mesh, tip).contains(&e)) {
                        continue;
                    }
                    let parts = space
                        .enrichments
                        .iter()
                        .filter(|x| matches!(x, Enrichment::Part { node: n, .. } if *n == node));
                    if parts.count() != 1 {
                        println!(
                            "{degrees} element {e} {:?} node {node} at {:?}",
                            mesh.element(e),
                            mesh.node_position(node)
                        );
                        for &e in &patch {
                            let cut = cuts.elements.get(&e);
                            println!("   {e} {:?} {:?}", mesh.element(e).lower, mesh.element(e).upper);
                            if let Some(cut) = cut {
                                println!(
                                    "   regions {:?} of {}; vertices {:?} cells {:?} cracks {:?}",
                                    cut.region,
                                    cut.regions,
                                    cut.arrangement.vertices,
                                    cut.arrangement.cells,
                                    cut.cracks
                                );
                            }
                            for side in [Edge::Top, Edge::Right] {
                                println!("     joined {side:?} {:?}", cuts.joined(&mesh, e, side));
                            }
                        }
                        panic!();
                    }
                }
            }
        }
    }
}
