//! Cross-sections of rails.

use crate::math::OutOfRange;

/// Cross-section of a rail in bending.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailSection {
    /// I about the horizontal axis, mm⁴, positive.
    pub second_moment: f64,
    /// h, depth of the neutral axis below the running surface, mm, positive.
    pub neutral_axis_depth: f64,
    /// H, from the running surface to the foot, mm; none where it is not known.
    pub height: Option<f64>,
}

impl RailSection {
    /// Rejects a section without second moment or neutral-axis depth, and a neutral axis below the
    /// foot.
    pub fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_positive("second moment of area (mm\u{2074})", self.second_moment)?;
        let depth = self.neutral_axis_depth;
        OutOfRange::unless_positive("depth of the neutral axis (mm)", depth)?;
        let inside = self.height.is_none_or(|height| depth < height);
        OutOfRange::unless(
            inside,
            "depth of the neutral axis (mm)",
            depth,
            "less than the height of the rail",
        )
    }
}

/// A rail section with a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedSection {
    /// The name in EN 13674-1.
    pub name: &'static str,
    /// Older names of the same section.
    pub aliases: &'static [&'static str],
    /// H, mm.
    pub height: f64,
    /// h, depth of the neutral axis below the running surface, mm.
    pub neutral_axis_depth: f64,
    /// Area, cm².
    pub area_cm2: f64,
    /// Width of the head, mm.
    pub head_width: f64,
    /// Width of the foot, mm.
    pub foot_width: f64,
    /// I, cm⁴.
    pub second_moment_cm4: f64,
    /// Section modulus of the head, cm³: I/W = h.
    pub head_modulus_cm3: f64,
    /// Section modulus of the foot, cm³: I/W = H − h.
    pub foot_modulus_cm3: f64,
}

/// The sections that are known by name. Source: EN 13674-1, annex of rail profiles, quoted from
/// memory; I/W_head = h and I/W_foot = H − h to 0.1 mm.
pub const SECTIONS: &[NamedSection] = &[
    NamedSection {
        name: "60E1",
        aliases: &["UIC60", "UIC 60"],
        height: 172.0,
        neutral_axis_depth: 91.05,
        area_cm2: 76.70,
        head_width: 72.0,
        foot_width: 150.0,
        second_moment_cm4: 3038.3,
        head_modulus_cm3: 333.6,
        foot_modulus_cm3: 375.5,
    },
    NamedSection {
        name: "54E1",
        aliases: &["UIC54", "UIC 54"],
        height: 159.0,
        neutral_axis_depth: 83.9,
        area_cm2: 69.77,
        head_width: 70.0,
        foot_width: 140.0,
        second_moment_cm4: 2337.9,
        head_modulus_cm3: 278.7,
        foot_modulus_cm3: 311.2,
    },
    NamedSection {
        name: "49E1",
        aliases: &["S49", "S 49"],
        height: 149.0,
        neutral_axis_depth: 75.6,
        area_cm2: 62.92,
        head_width: 67.0,
        foot_width: 125.0,
        second_moment_cm4: 1816.0,
        head_modulus_cm3: 240.3,
        foot_modulus_cm3: 247.5,
    },
];

impl NamedSection {
    /// The section called `name`, regardless of case.
    pub fn of(name: &str) -> Option<&'static Self> {
        let same = |other: &str| other.eq_ignore_ascii_case(name.trim());
        SECTIONS.iter().find(|section| same(section.name) || section.aliases.iter().any(|alias| same(alias)))
    }

    /// The data of its bending.
    pub fn section(&self) -> RailSection {
        RailSection {
            second_moment: 1e4 * self.second_moment_cm4,
            neutral_axis_depth: self.neutral_axis_depth,
            height: Some(self.height),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_second_moment_and_height_fit_each_other() {
        const TOLERANCE: f64 = 0.1; // mm: four digits of each
        for section in SECTIONS {
            let [above, below] = [section.head_modulus_cm3, section.foot_modulus_cm3]
                .map(|modulus| 10.0 * section.second_moment_cm4 / modulus);
            assert!((above - section.neutral_axis_depth).abs() < TOLERANCE, "{}: {above}", section.name);
            assert!((above + below - section.height).abs() < TOLERANCE, "{}: {below}", section.name);
            assert!(section.section().check().is_ok());
        }
    }

    #[test]
    fn known_by_old_and_new_names() {
        assert_eq!(NamedSection::of("uic 60"), NamedSection::of("60E1"));
        assert!(NamedSection::of("60E1").is_some() && NamedSection::of("61E1").is_none());
    }
}
