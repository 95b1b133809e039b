//! The nearest known name.

/// The name among `names` that is most similar to `given`; the first one in a tie.
pub(crate) fn nearest<'a>(given: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let mut best: Option<(f64, &str)> = None;
    for name in names {
        let likeness = strsim::jaro_winkler(&given, name);
        if best.is_none_or(|(most, _)| likeness > most) {
            best = Some((likeness, name));
        }
    }
    best.map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen() {
        let names = ["young_modulus_mpa", "poisson_ratio", "width_mm", "depth_mm"];
        for (given, want) in
            [("youngs_modulus", "young_modulus_mpa"), ("widht_mm", "width_mm"), ("Depth", "depth_mm")]
        {
            assert_eq!(nearest(given, names), Some(want), "{given}");
        }
        assert_eq!(nearest("x", []), None);
    }
}
