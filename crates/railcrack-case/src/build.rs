//! From accepted values to a case: what one key alone does not tell.

use super::accept::Value;
use super::cracks::{PlacedCracks, check_fit, place_cracks};
use super::error::{Fault, Report};
use super::field_file::read_field;
use super::profile::{ProfileFile, read_profile};
use super::section::SectionValues;
use super::sections::SECTIONS;
use super::table::{Kind, NumberRange};
use super::validated::{
    Case, ContactSolver, Engine, FieldOutput, INITIAL_RESIDUAL_NAME, MeshSettings, PLASTIC_FIELD_NAME,
    PLASTIC_PROFILE_NAME, PlasticSource, RESIDUAL_STRESS_NAME, Rail, ShakedownSettings,
};
use railcrack::bulk::{BottomSupport, Boundary, SideSupport};
use railcrack::contact::StepControl;
use railcrack::fatigue::{DangVan, DirectionCriterion, ParisLaw};
use railcrack::growth::{GrowthSettings, PassageSettings};
use railcrack::load::{HertzianContact, Passage};
use railcrack::material::{IsotropicElastic, KinematicHardening};
use railcrack::shakedown::Method;
use std::path::Path;

/// The case that `sections` describe; `None` where something is wrong or missing, which `report` then says.
///
/// Every part is built, even where another is wrong, so that all errors are found at once.
pub(super) fn build(sections: &[SectionValues], folder: &Path, report: &mut Report) -> Option<Case> {
    let section = |name: &str| sections.iter().find(|s| s.section.name == name);
    let steel = section("rail").and_then(|s| steel(s, report));
    let contact = section("contact").zip(steel.as_ref()).and_then(|(s, steel)| contact(s, steel, report));
    let crack_sections: Vec<&SectionValues> = sections.iter().filter(|s| s.section.name == "crack").collect();
    let placed = place_cracks(&crack_sections, report);
    let rail = section("rail").and_then(|s| rail(s, placed.as_ref()));
    if let (Some(rail), Some(placed)) = (&rail, &placed) {
        check_fit(placed, rail, &crack_sections, report);
    }
    let passage = section("passage").and_then(|s| passage(s, contact.as_ref(), placed.as_ref(), report));
    if let Some(rail) = &rail {
        let wheel = contact.as_ref().zip(passage.as_ref());
        check_block(rail, section("solver").and_then(engine), wheel, &section, report);
    }
    let residual_stress = section("residual_stress").and_then(|s| profile(s, "profile", folder, report));
    let plastic = section("plastic_stress").map(|s| plastic_stress(s, folder, report));
    if let (Some(Some(PlasticSource::Rolled)), Some(plastic), Some(_)) =
        (&plastic, section("plastic_stress"), section("residual_stress"))
    {
        report.add(counted_twice(plastic));
    }
    let shakedown = section("shakedown").and_then(|s| shakedown(s, folder, report));
    let placed = placed?;
    let rail = rail?;
    Some(Case {
        title: section("")?.text("title")?.into(),
        steel: steel?,
        rail,
        contact: contact?,
        passages: passages(section("passage")?, passage?)?,
        cracks: placed.network,
        crack_friction: placed.friction,
        residual_stress,
        plastic_stress: match plastic {
            Some(source) => Some(source?),
            None => None,
        },
        shakedown: shakedown?,
        growth: growth(section("growth")?)?,
        mesh: mesh(section("mesh")?)?,
        engine: engine(section("solver")?)?,
        contact_solver: contact_solver(section("solver")?)?,
        fields: fields(section("output")?)?,
        axle_load: section("traffic").and_then(|s| s.number("axle_load_t")),
        written: written(sections, &rail),
    })
}

fn steel(section: &SectionValues, report: &mut Report) -> Option<IsotropicElastic> {
    let (young, poisson) = (section.number("young_modulus_mpa")?, section.number("poisson_ratio")?);
    IsotropicElastic::new(young, poisson)
        .map_err(|error| {
            report.add(Fault {
                message: format!("`rail`: {error}"),
                key: Some("rail".into()),
                span: Some(section.span.clone()),
                ..Fault::default()
            });
        })
        .ok()
}

fn contact(
    section: &SectionValues,
    steel: &IsotropicElastic,
    report: &mut Report,
) -> Option<HertzianContact> {
    let friction = section.number("friction")?;
    if let (Some(peak_pressure), Some(half_width)) =
        (section.number("peak_pressure_mpa"), section.number("half_width_mm"))
    {
        return Some(HertzianContact { peak_pressure, half_width, friction });
    }
    let line_load = section.number("line_load_n_per_mm")?;
    let (wheel, rail) = (section.number("wheel_radius_mm")?, section.number("rail_radius_mm")?);
    let mut refuse = |message: String| {
        report.add(Fault {
            message,
            key: Some("contact.line_load_n_per_mm".into()),
            span: Some(section.span_of("line_load_n_per_mm")),
            help: Some("line load and radii together give the peak pressure and the half width".into()),
            also: None,
        });
    };
    match HertzianContact::from_line_load(line_load, wheel, rail, steel, friction) {
        Ok(contact) => {
            let outside =
                [("peak_pressure_mpa", contact.peak_pressure), ("half_width_mm", contact.half_width)]
                    .into_iter()
                    .find_map(|(name, value)| {
                        let range = range_of(section, name).filter(|range| !range.contains(value))?;
                        Some(format!("{name} = {value:.4}: must be in {range}"))
                    });
            match outside {
                None => Some(contact),
                Some(outside) => {
                    refuse(format!("`contact.line_load_n_per_mm = {line_load}` gives {outside}"));
                    None
                }
            }
        }
        Err(error) => {
            refuse(format!("`contact`: {error}"));
            None
        }
    }
}

fn range_of(section: &SectionValues, key: &str) -> Option<NumberRange> {
    match section.section.key(key)?.kind {
        Kind::Number { range, .. } => Some(range),
        _ => None,
    }
}

fn rail(section: &SectionValues, placed: Option<&PlacedCracks>) -> Option<Rail> {
    if section.is_refused("centre_mm") {
        return None;
    }
    let middle = placed.map(|p| 0.5 * (p.network.leftmost_mouth() + p.network.rightmost_mouth()));
    Some(Rail {
        width: section.number("width_mm")?,
        depth: section.number("depth_mm")?,
        centre: section.number("centre_mm").or(middle)?,
        boundary: match section.text("boundary")? {
            "half-plane" => Boundary::HalfPlane,
            "block" => Boundary::Block {
                bottom: match section.text("bottom")? {
                    "clamped" => BottomSupport::Clamped,
                    "rollers" => BottomSupport::Rollers,
                    _ => return None,
                },
                sides: match section.text("sides")? {
                    "free" => SideSupport::Free,
                    "rollers" => SideSupport::Rollers,
                    "clamped" => SideSupport::Clamped,
                    _ => return None,
                },
            },
            _ => return None,
        },
    })
}

fn passage(
    section: &SectionValues,
    contact: Option<&HertzianContact>,
    placed: Option<&PlacedCracks>,
    report: &mut Report,
) -> Option<Passage> {
    let (from, to) = (section.number("from_over_a")?, section.number("to_over_a")?);
    if from == to {
        report.add(Fault {
            message: format!("`passage.to_over_a = {to}`: must differ from from_over_a"),
            key: Some("passage.to_over_a".into()),
            span: Some(section.span_of("to_over_a")),
            help: Some("the wheel has to move; from > to is a wheel that runs towards -x".into()),
            also: None,
        });
        return None;
    }
    let (contact, network) = (contact?, &placed?.network);
    // The wheel meets the cracks one after the other: it starts before the first mouth on its way and ends behind
    // the last one.
    let (first, last) = if from < to {
        (network.leftmost_mouth(), network.rightmost_mouth())
    } else {
        (network.rightmost_mouth(), network.leftmost_mouth())
    };
    Some(Passage {
        from: first + from * contact.half_width,
        to: last + to * contact.half_width,
        positions: count(section, "positions")?,
    })
}

/// Smallest gap between the contact and the side of a block, over the half-width: closer, the sides bear a part of the contact.
const SIDE_GAP: f64 = 1.0;

/// A block needs the finite-element engine, and a wheel that stays on its top.
fn check_block<'a>(
    rail: &Rail,
    engine: Option<Engine>,
    wheel: Option<(&HertzianContact, &Passage)>,
    section: &dyn Fn(&str) -> Option<&'a SectionValues>,
    report: &mut Report,
) {
    if rail.boundary == Boundary::HalfPlane {
        return;
    }
    if let (Some(Engine::Dislocation), Some(solver)) = (engine, section("solver")) {
        report.add(Fault {
            message:
                "`solver.engine = \"dislocation\"`: knows the half-plane only, and rail.boundary is \"block\""
                    .into(),
            key: Some("solver.engine".into()),
            span: Some(solver.span_of("engine")),
            help: Some(
                "engine = \"xfem\" computes a block; boundary = \"half-plane\" suits both engines".into(),
            ),
            also: None,
        });
    }
    let (Some((contact, passage)), Some(section)) = (wheel, section("passage")) else { return };
    let reach = 0.5 * rail.width - (1.0 + SIDE_GAP) * contact.half_width;
    for (key, at) in [("from_over_a", passage.from), ("to_over_a", passage.to)] {
        if (at - rail.centre).abs() > reach {
            let over_a = section.number(key).unwrap_or_default();
            report.add(Fault {
                message: format!(
                    "`passage.{key} = {over_a}`: puts the wheel at x = {at} mm, and the top of the block leaves it {} to {} mm",
                    rail.centre - reach,
                    rail.centre + reach
                ),
                key: Some(format!("passage.{key}")),
                span: Some(section.span_of(key)),
                help: Some("a wider block ([rail] width_mm) or a shorter passage".into()),
                also: None,
            });
        }
    }
}

fn fields(section: &SectionValues) -> Option<FieldOutput> {
    Some(FieldOutput {
        over_a: section.numbers("fields_over_a")?.to_vec(),
        every: count(section, "fields_every")?,
    })
}

fn passages(section: &SectionValues, passage: Passage) -> Option<PassageSettings> {
    Some(PassageSettings {
        passage,
        max_passages: count(section, "max_passages")?,
        passage_tolerance: section.number("passage_tolerance")?,
        step_tolerance: section.number("step_tolerance")?,
        step_control: match section.text("step_control")? {
            "fixed" => StepControl::Fixed,
            _ => StepControl::Adaptive,
        },
    })
}

fn profile(section: &SectionValues, key: &str, folder: &Path, report: &mut Report) -> Option<ProfileFile> {
    let dotted = format!("{}.{key}", section.path);
    read_profile(section.text(key)?, folder, &dotted, section.span_of(key), report)
}

fn plastic_stress(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<PlasticSource> {
    if let Some(given) = section.text("field") {
        let dotted = format!("{}.field", section.path);
        let file = read_field(given, folder, &dotted, section.span_of("field"), report)?;
        return Some(PlasticSource::Field(file));
    }
    if section.text("profile").is_some() {
        return Some(PlasticSource::Profile(profile(section, "profile", folder, report)?));
    }
    let refused = section.is_refused("field") || section.is_refused("profile");
    (!refused).then_some(PlasticSource::Rolled)
}

/// A residual stress is a total, and the computed state starts from a manufacturing stress of its own.
fn counted_twice(plastic: &SectionValues) -> Fault {
    Fault {
        message: "`[plastic_stress]` without field computes what rolling leaves, and `[residual_stress]` is a total already".into(),
        key: Some("plastic_stress".into()),
        span: Some(plastic.span.clone()),
        help: Some("a stress that was there before the first passage is `initial_residual` of [shakedown]".into()),
        also: None,
    }
}

fn shakedown(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<ShakedownSettings> {
    let initial_residual = profile(section, "initial_residual", folder, report);
    let (yield_stress, modulus) =
        (section.number("yield_stress_mpa")?, section.number("hardening_modulus_mpa")?);
    let hardening = KinematicHardening::new(yield_stress, modulus)
        .map_err(|error| {
            report.add(Fault {
                message: format!("`shakedown`: {error}"),
                key: Some("shakedown".into()),
                span: Some(section.span.clone()),
                ..Fault::default()
            });
        })
        .ok()?;
    Some(ShakedownSettings {
        hardening,
        method: match section.text("method")? {
            "pass-by-pass" => Method::PassByPass,
            "direct" => Method::Direct,
            _ => return None,
        },
        max_passes: count(section, "max_passes")?,
        initial_residual,
        dang_van: DangVan { slope: section.number("dang_van_a")?, limit: section.number("dang_van_b_mpa")? },
    })
}

fn growth(section: &SectionValues) -> Option<GrowthSettings> {
    Some(GrowthSettings {
        steps: count(section, "steps")?,
        increment: section.number("increment")?,
        law: ParisLaw {
            c: section.number("paris_c")?,
            m: section.number("paris_m")?,
            mode_2_weight: section.number("mode_2_weight")?,
            threshold: section.number("threshold_mpa_sqrt_m")?,
        },
        arrest_rate: section.number("arrest_rate_mm_per_cycle")?,
        criterion: match section.text("direction")? {
            "max-rate" => DirectionCriterion::MaxRate,
            "max-rate-unclipped" => DirectionCriterion::MaxRateUnclipped,
            "max-delta-k1" => DirectionCriterion::MaxDeltaK1,
            "max-k1" => DirectionCriterion::MaxK1,
            _ => return None,
        },
        critical_length: section.number("critical_length_mm"),
        toughness: None,
        stop_after_cycles: section.number("stop_after_cycles"),
    })
}

fn mesh(section: &SectionValues) -> Option<MeshSettings> {
    Some(MeshSettings {
        element_size: section.number("element_size_mm"),
        tip_enrichment_radius: section.number("tip_enrichment_radius_mm"),
        interface_spacing: section.number("interface_spacing_mm"),
        interface_elements: count(section, "interface_elements"),
    })
}

fn engine(section: &SectionValues) -> Option<Engine> {
    match section.text("engine")? {
        "xfem" => Some(Engine::Xfem),
        "dislocation" => Some(Engine::Dislocation),
        _ => None,
    }
}

fn contact_solver(section: &SectionValues) -> Option<ContactSolver> {
    match section.text("contact")? {
        "newton" => Some(ContactSolver::Newton),
        "latin" => Some(ContactSolver::Latin),
        _ => None,
    }
}

fn count(section: &SectionValues, key: &str) -> Option<usize> {
    usize::try_from(section.integer(key)?).ok()
}

/// What the case says with every default filled in, the middle of the rail included, and with files under the
/// names that [`Case::companions`] gives them.
fn written(sections: &[SectionValues], rail: &Rail) -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let mut written = Vec::new();
    for declared in SECTIONS {
        for section in sections.iter().filter(|s| s.section.name == declared.name) {
            let mut values = section.values();
            if declared.name == "rail" && section.entry("centre_mm").is_none() {
                let after = values.iter().position(|(name, _)| *name == "depth_mm").map_or(0, |i| i + 1);
                values.insert(after, ("centre_mm", Value::Number(rail.centre)));
            }
            for (name, value) in &mut values {
                match (declared.name, *name) {
                    ("residual_stress", "profile") => *value = Value::Text(RESIDUAL_STRESS_NAME.into()),
                    ("plastic_stress", "field") => *value = Value::Text(PLASTIC_FIELD_NAME.into()),
                    ("plastic_stress", "profile") => *value = Value::Text(PLASTIC_PROFILE_NAME.into()),
                    ("shakedown", "initial_residual") => *value = Value::Text(INITIAL_RESIDUAL_NAME.into()),
                    _ => (),
                }
            }
            written.push((declared.name, values));
        }
    }
    written
}
