//! The wheels of a case, a row each.

use crate::setup::WheelDemand;
use railcrack::load::Contact;
use railcrack::rolling::{PatchForces, PlacedPatch};
use railcrack_case::{Case, ContactOrigin, GivenContact, TrafficWheel};

/// A wheel with its patches and what it makes of the cracks.
#[derive(Debug, Clone, Default)]
pub struct WheelRow {
    /// Its number: of the table, or from 1.
    pub number: u64,
    /// Its place along the track, m, in a table with places.
    pub place: Option<f64>,
    /// The row of the wheel that represents it; none of one that misses the crack.
    pub represented_by: Option<usize>,
    /// Its share of the axles.
    pub share: f64,
    /// p0, MPa, of the patch over the crack, or of the first; of a line contact, of the strip.
    pub peak_pressure: f64,
    /// a, mm, of the same patch.
    pub along: f64,
    /// b, mm; none of a line contact.
    pub across: Option<f64>,
    /// F_x, F_y on the rail, N, of all patches.
    pub force: Option<[f64; 2]>,
    /// Forces on the rail downwards and towards +y, N, of all patches, where angles are known.
    pub upright_force: Option<[f64; 2]>,
    /// The part of its patches that slips.
    pub slip_share: Option<f64>,
    /// Tγ without the work of the spin, N.
    pub t_gamma: Option<f64>,
    /// Tγ with it, N.
    pub t_gamma_with_spin: Option<f64>,
    /// Lateral place of the patch on the rail, mm, in a table.
    pub y_rail: Option<f64>,
    /// ΔK_eq of its passage, MPa√m, the largest of all tips.
    pub delta_keq: f64,
    /// Growth rate under this wheel alone, mm per axle.
    pub rate: f64,
    /// Its share of the growth.
    pub growth_share: f64,
    /// Its patches with the place of the crack in them.
    pub patches: Vec<PlacedPatch>,
}

impl WheelRow {
    /// The wheels of `case` with their `demands`.
    pub fn of_case(case: &Case, demands: &[WheelDemand]) -> Vec<Self> {
        let mut rows: Vec<Self> = match &case.wheel_table {
            Some(table) => {
                let representatives = table.groups.iter().flat_map(|groups| {
                    groups.group_of.iter().map(|group| groups.representatives.get((*group)?).copied())
                });
                table
                    .wheels
                    .iter()
                    .zip(representatives)
                    .map(|(wheel, represented_by)| {
                        let patches = wheel.wheel.over(table.lateral);
                        let over = patches.iter().position(|own| own.patch.half_length(own.y) > 0.0);
                        let main = wheel.wheel.patches[over.unwrap_or(0)].y_rail;
                        let angles: Option<Vec<f64>> =
                            wheel.wheel.patches.iter().map(|own| own.angle).collect();
                        let identity = (wheel.wheel.number, wheel.share);
                        let row = Self::rolling(identity, patches, over.unwrap_or(0), angles);
                        Self { y_rail: Some(main), place: wheel.wheel.place, represented_by, ..row }
                    })
                    .collect()
            }
            None => {
                let given =
                    |(i, own): (usize, &TrafficWheel)| Some(Self::given(i, own.share, own.wheel.given()?));
                case.wheels.iter().enumerate().filter_map(given).collect()
            }
        };
        let total: f64 = rows.iter().zip(demands).map(|(row, demand)| row.share * demand.rate).sum();
        for (row, demand) in rows.iter_mut().zip(demands) {
            (row.delta_keq, row.rate) = (demand.delta_keq, demand.rate);
            row.growth_share = if total > 0.0 { row.share * demand.rate / total } else { 0.0 };
        }
        rows
    }

    fn given(index: usize, share: f64, GivenContact { contact, origin, .. }: &GivenContact) -> Self {
        let number = index as u64 + 1;
        let row = match origin {
            ContactOrigin::Profiles(own) => {
                let over = own.placed.iter().position(|own| own.patch.half_length(own.y) > 0.0).unwrap_or(0);
                let angles: Vec<f64> = own.contacts.iter().map(|contact| contact.angle).collect();
                let y_rail = own.contacts.get(over).map(|contact| contact.y);
                Self { y_rail, ..Self::rolling((number, share), own.placed.clone(), over, Some(angles)) }
            }
            ContactOrigin::Rolling { patch, lateral, .. } => {
                let placed = PlacedPatch { patch: **patch, y: *lateral, x: 0.0 };
                Self::rolling((number, share), vec![placed], 0, None)
            }
            ContactOrigin::Ellipse { ellipse, .. } | ContactOrigin::GivenEllipse { ellipse, .. } => Self {
                peak_pressure: ellipse.peak_pressure,
                along: ellipse.along,
                across: Some(ellipse.across),
                // Every strip has the same ratio of shear to pressure.
                force: Some([ellipse.load() * contact.adhesion(), 0.0]),
                ..Self::of_line(number, share, contact)
            },
            _ => Self::of_line(number, share, contact),
        };
        Self { represented_by: Some(index), ..row }
    }

    fn of_line(number: u64, share: f64, contact: &Contact) -> Self {
        let slip_share = match contact {
            Contact::Hertz(hertz) => Some(if hertz.friction == 0.0 { 0.0 } else { 1.0 }),
            Contact::Carter(carter) => Some(1.0 - carter.stick_half_width() / carter.half_width),
            Contact::Table(_) => None,
        };
        Self {
            number,
            share,
            peak_pressure: contact.peak_pressure(),
            along: contact.half_width(),
            slip_share,
            ..Self::default()
        }
    }

    fn rolling(
        (number, share): (u64, f64),
        patches: Vec<PlacedPatch>,
        main: usize,
        angles: Option<Vec<f64>>,
    ) -> Self {
        let ellipse = patches[main].patch.ellipse;
        let forces: Vec<PatchForces> = patches.iter().map(|own| own.patch.forces()).collect();
        let area = |own: &PlacedPatch| own.patch.ellipse.along * own.patch.ellipse.across;
        let areas: f64 = patches.iter().map(area).sum();
        let sum = |of: fn(&PatchForces) -> f64| forces.iter().map(of).sum::<f64>();
        let slipping: f64 =
            forces.iter().zip(&patches).map(|(own, patch)| own.slip_share * area(patch)).sum();
        Self {
            number,
            share,
            peak_pressure: ellipse.peak_pressure,
            along: ellipse.along,
            across: Some(ellipse.across),
            force: Some([sum(|own| own.force[0]), sum(|own| own.force[1])]),
            upright_force: angles.map(|angles| upright(&patches, &forces, &angles)),
            slip_share: Some(slipping / areas),
            t_gamma: Some(sum(|own| own.t_gamma)),
            t_gamma_with_spin: Some(sum(|own| own.t_gamma_with_spin)),
            patches,
            ..Self::default()
        }
    }
}

/// The wheels of `rows` that grow the cracks most, those first.
pub fn by_growth(rows: &[WheelRow]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by(|a, b| rows[*b].growth_share.total_cmp(&rows[*a].growth_share).then(a.cmp(b)));
    order
}

/// Forces on the rail downwards and towards +y (N) of patches whose planes fall towards +y by
/// `angles` (rad): N cos γ + F_y sin γ and F_y cos γ − N sin γ.
fn upright(patches: &[PlacedPatch], forces: &[PatchForces], angles: &[f64]) -> [f64; 2] {
    let of = |((own, forces), angle): ((&PlacedPatch, &PatchForces), &f64)| {
        let (normal, across) = (own.patch.normal_force(), forces.force[1]);
        let (sin, cos) = angle.sin_cos();
        [normal * cos + across * sin, across * cos - normal * sin]
    };
    let sum = |sum: [f64; 2], own: [f64; 2]| [sum[0] + own[0], sum[1] + own[1]];
    patches.iter().zip(forces).zip(angles).map(of).fold([0.0; 2], sum)
}
