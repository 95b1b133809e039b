//! Keys of `[contact]` for a wheel that feels the cracks.

use super::contact::{COUPLED, COUPLED_WITHIN, SURFACE_NODES};
use crate::schema::{Report, SectionValues};
use railcrack::coupling::{CoupledContact, WheelCoupling};
use railcrack::load::Contact;
use railcrack::material::IsotropicElastic;

/// How the wheel of `contact` on a rail of `steel` feels the cracks; the inner option is none for
/// the contact on the uncracked rail, the outer one for keys with errors, which are added to
/// `report`.
#[expect(clippy::option_option, reason = "a wheel without it, and keys with errors")]
pub(super) fn read_coupling(
    section: &SectionValues,
    contact: &Contact,
    steel: &IsotropicElastic,
    report: &mut Report,
) -> Option<Option<WheelCoupling>> {
    if section.get(COUPLED) != Some(true) {
        let help = "add coupled = true, or leave the key out";
        let says = "describes a wheel that feels the cracks, and coupled is not true";
        let nodes = section.entry(SURFACE_NODES).map(|_| section.fault(SURFACE_NODES, says));
        let within = section.entry(COUPLED_WITHIN).map(|_| section.fault(COUPLED_WITHIN, says));
        let mut is_right = true;
        for fault in nodes.into_iter().chain(within) {
            report.add(fault.help(help));
            is_right = false;
        }
        return is_right.then_some(None);
    }
    let nodes = section.get(SURFACE_NODES).map_or(WheelCoupling::NODES_PER_HALF_WIDTH, |n| n as f64);
    Some(Some(WheelCoupling {
        contact: CoupledContact::new(contact, steel),
        nodes_per_half_width: nodes,
        within: section.get(COUPLED_WITHIN).unwrap_or(WheelCoupling::WITHIN),
    }))
}
