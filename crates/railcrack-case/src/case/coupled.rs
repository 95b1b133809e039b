//! Cases with a wheel that feels the cracks: what they exclude.

use crate::schema::{Report, Sections};
use crate::tables::{
    CONTACT, COUPLED, ContactExtent, ENGINE, Engine, LATERAL_EXTENT, NETWORK, SOLVER, WHEEL_CONTACT,
};
use railcrack::bulk::Boundary;
use railcrack::contact::{CrackFluid, FluidModel};
use railcrack::growth::NetworkContact;

/// Refuses sections that a wheel that feels the cracks does not support.
pub(super) fn check_coupled<'f>(
    sections: &Sections,
    boundary: Option<Boundary>,
    fluids: impl Iterator<Item = &'f CrackFluid>,
    report: &mut Report,
) {
    let contacts = sections.all(&CONTACT).chain(sections.all(&WHEEL_CONTACT));
    let mut contacts = contacts.filter(|contact| contact.get(COUPLED) == Some(true));
    let Some(coupled) = contacts.next() else { return };
    let mut refuse = |says: &str, help: &str| report.add(coupled.fault(COUPLED, says).help(help));
    if boundary.is_some_and(|boundary| boundary != Boundary::HalfPlane) {
        let says = "is true, and the surface of a block is not that of a half-plane";
        refuse(says, "use rail.boundary = \"half-plane\", or coupled = false");
    }
    if coupled.get(LATERAL_EXTENT) == Some(ContactExtent::Patch) {
        let says = "is true, and a wheel that feels the cracks is a line contact";
        refuse(says, "leave lateral = \"patch\" out, or use coupled = false");
    }
    if let Some(solver) = sections.one(&SOLVER) {
        if solver.get(ENGINE).is_some_and(Engine::is_in_space) {
            let says = "is true, and the space engine computes the contact on the uncracked rail only";
            refuse(says, "use engine = \"dislocation\" or \"xfem\", or coupled = false");
        }
        if solver.get(NETWORK) == Some(NetworkContact::Groups) {
            let says = "is true, and cracks in groups are followed under a known contact pressure only";
            refuse(says, "use solver.network = \"whole\", or coupled = false");
        }
    }
    let mut models = fluids.map(|fluid| fluid.model);
    if models.any(|model| matches!(model, FluidModel::Mouth { cap } if cap.is_finite())) {
        let says = "is true: the wheel itself limits the pressure from the mouth, and pressure_cap_mpa would do so again";
        refuse(says, "leave pressure_cap_mpa out, or use coupled = false");
    }
}
