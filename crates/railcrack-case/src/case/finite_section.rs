//! Cases whose cracked rail has head, web and foot: what they exclude.

use crate::schema::{Report, Sections};
use crate::tables::{
    CONTACT, COUPLED, CRACKED_SECTION, CrackedSection, ENGINE, Engine, NETWORK, RAIL, Rail, SOLVER,
    WHEEL_CONTACT,
};
use railcrack::growth::NetworkContact;
use railcrack::load::Track;

/// Refuses what is computed for the half-plane only, and a `track` (of any wheel) whose rail bends
/// as another section.
pub(super) fn check_section<'t>(
    sections: &Sections,
    rail: Option<&Rail>,
    mut tracks: impl Iterator<Item = &'t Track>,
    report: &mut Report,
) {
    let (Some(given), Some(rail)) = (sections.one(&RAIL), rail) else { return };
    let Some(section) = rail.section else {
        if given.get(CRACKED_SECTION) == Some(CrackedSection::OfTrack) {
            let says = "is that of [track], which gives none with a name";
            let help = "give [track] a section, such as section = \"60E1\", or give it here";
            report.add(given.fault(CRACKED_SECTION, says).help(help));
        }
        return;
    };
    let mut refuse = |says: &str, help: &str| report.add(given.fault(CRACKED_SECTION, says).help(help));
    if let Some(solver) = sections.one(&SOLVER) {
        if solver.get(ENGINE).is_some_and(Engine::is_in_space) {
            let says = "is given, and the space engine computes a half-space only";
            refuse(says, "use engine = \"dislocation\" or \"xfem\", or leave section out");
        }
        if solver.get(NETWORK) == Some(NetworkContact::Groups) {
            let says = "is given, and cracks in groups are computed in a half-plane only";
            refuse(says, "use solver.network = \"whole\", or leave section out");
        }
    }
    let mut contacts = sections.all(&CONTACT).chain(sections.all(&WHEEL_CONTACT));
    if contacts.any(|contact| contact.get(COUPLED) == Some(true)) {
        let says = "is given, and the surface under a coupled wheel is that of a half-plane";
        refuse(says, "use [contact] coupled = false, or leave section out");
    }
    if tracks.any(|track| track.section != section.section()) {
        let says = "is not the section of [track]: one rail cannot have two";
        refuse(says, "give both the same section");
    }
}
