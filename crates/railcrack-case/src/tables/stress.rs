//! `[residual_stress]` and `[plastic_stress]`: stress that rolling or manufacture left in the rail.

use crate::files::{Companion, FieldFile, ProfileFile, read_field, read_profile};
use crate::schema::{Choice, Report, SectionValues, Word, choice, file, read_by_word, section};
use railcrack::residual::{PlasticField, PlasticFieldError};
use std::path::Path;

section! {
    RESIDUAL_STRESS "residual_stress", Optional,
        "A balanced residual stress over depth, added to that of the wheel.";
    PROFILE: String = file("profile", "inputs/residual-stress.csv", "profile.csv",
        "CSV file with the columns depth_mm,sxx_mpa[,szz_mpa]; linear between rows, zero below the last.").required();
}

section! {
    PLASTIC_STRESS "plastic_stress", Optional,
        "A plastic stress 2 G eps_p, which the run balances. Without a file, that of the stabilised state of [shakedown]; under a patch, the balanced stress of that state.",
        forms [[PLASTIC_FIELD], [PLASTIC_PROFILE], [PLASTIC_FROM]];
    PLASTIC_FIELD: String = file("field", "inputs/plastic-stress.vtu", "shakedown/plastic.vtu",
        "VTU file with plastic_stress_mpa at points or cells, such as that of `railcrack shakedown`.")
        .optional();
    PLASTIC_PROFILE: String = file("profile", "inputs/plastic-stress.csv", "plastic.csv",
        "CSV file in the format of [residual_stress], read as a plastic stress.").optional();
    PLASTIC_FROM: PlasticFrom = choice("from", "Origin without a file.").optional();
}

read_by_word!(PlasticFrom);

/// Origin of a plastic stress that no file gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlasticFrom {
    Passages,
}

impl Choice for PlasticFrom {
    const WORDS: &'static [(Self, Word)] =
        &[(Self::Passages, Word::now("passages", "the stabilised state, computed first"))];
}

/// Origin of a plastic stress.
#[derive(Debug, Clone, PartialEq)]
pub enum PlasticSource {
    /// A field on a mesh.
    Field(FieldFile),
    /// A profile by depth.
    Profile(ProfileFile),
    /// The stabilised state under the wheel of the case, computed first.
    Rolled,
}

impl PlasticSource {
    /// Files are relative to `folder`.
    pub(crate) fn read(section: &SectionValues, folder: &Path, report: &mut Report) -> Option<Self> {
        if section.entry(PLASTIC_FIELD).is_some() {
            return read_field(section, PLASTIC_FIELD, folder, report).map(Self::Field);
        }
        if section.entry(PLASTIC_PROFILE).is_some() {
            let file = read_profile(section, PLASTIC_PROFILE, folder, report)?;
            // A stress at the surface alone fills no layer.
            if file.content().rows().last().is_none_or(|deepest| deepest.0 <= 0.0) {
                let says =
                    "a plastic stress must extend below the surface: a row with depth_mm > 0 is missing";
                return report.refuse(section.fault(PLASTIC_PROFILE, says));
            }
            return Some(Self::Profile(file));
        }
        let refused = section.is_refused(PLASTIC_FIELD) || section.is_refused(PLASTIC_PROFILE);
        (!refused).then_some(Self::Rolled)
    }

    /// The plastic stress where it is given; none where the run computes it first.
    ///
    /// Errors: a profile that fills no layers.
    pub fn given_field(&self) -> Result<Option<PlasticField>, PlasticFieldError> {
        Ok(match self {
            Self::Field(file) => Some(file.content().clone()),
            Self::Profile(file) => Some(PlasticField::layers(file.content())?),
            Self::Rolled => None,
        })
    }

    /// The file stored with a case; none where the run computes the stress.
    pub(crate) fn companion(&self) -> Option<Companion<'_>> {
        match self {
            Self::Field(file) => Some(file.companion()),
            Self::Profile(file) => Some(file.companion()),
            Self::Rolled => None,
        }
    }

    /// The name in results.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Field(_) => "field",
            Self::Profile(_) => "profile",
            Self::Rolled => "rolled",
        }
    }
}
