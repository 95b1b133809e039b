//! Rows of cracks that scatter.

use railcrack_case::Case;
use std::path::Path;

fn text(keys: &str) -> String {
    format!(
        "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\nfriction = 0.1\n[rail]\nwidth_mm = 2000.0\n\
         [[crack]]\nmouth_mm = 5.0\nlength_mm = 6.0\nangle_deg = 15.0\nfriction = 0.5\n{keys}\n"
    )
}

/// Mouth (mm), length (mm) and angle (degrees) of each crack.
fn row(keys: &str) -> Vec<[f64; 3]> {
    let case = Case::parse(&text(keys), "case.toml", Path::new("")).expect(keys);
    let of = |crack: &railcrack::crack::Crack| {
        let way = crack.points()[1] - crack.points()[0];
        [crack.points()[0].x, crack.length(), -way.angle().to_degrees()]
    };
    case.cracks.cracks().iter().map(of).collect()
}

const SCATTER: &str = "length_sd_mm = 0.5\nangle_sd_deg = 1.5\nspacing_sd_mm = 0.4";

#[test]
fn a_row_scatters_about_the_values_of_its_section() {
    let cracks = row(&format!("count = 100\nspacing_mm = 3.4\n{SCATTER}"));
    assert_eq!((cracks.len(), cracks[0][0]), (100, 5.0), "the first mouth stays");
    let gaps: Vec<f64> = cracks.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let values = [
        (gaps, 3.4, 0.4),
        (cracks.iter().map(|c| c[1]).collect(), 6.0, 0.5),
        (cracks.iter().map(|c| c[2]).collect(), 15.0, 1.5),
    ];
    for (values, mean, deviation) in values {
        let count = values.len() as f64;
        let drawn = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|value| (value - drawn).powi(2)).sum::<f64>() / count;
        // Three and four standard errors of a hundred.
        assert!((drawn - mean).abs() < 0.3 * deviation, "{drawn} about {mean}");
        assert!((variance.sqrt() / deviation - 1.0).abs() < 0.3, "{} of {deviation}", variance.sqrt());
        assert!(values.iter().all(|value| (value - mean).abs() <= 3.0 * deviation + 1e-9));
    }
}

#[test]
fn a_seed_is_a_row_and_each_deviation_has_numbers_of_its_own() {
    let all = row(&format!("count = 20\nspacing_mm = 3.4\n{SCATTER}"));
    assert_eq!(all, row(&format!("count = 20\nspacing_mm = 3.4\n{SCATTER}\nseed = 1")), "the default seed");
    assert_eq!(all[..7], row(&format!("count = 7\nspacing_mm = 3.4\n{SCATTER}")), "fewer copies");
    assert_ne!(all, row(&format!("count = 20\nspacing_mm = 3.4\n{SCATTER}\nseed = 2")));
    let lengths = row("count = 20\nspacing_mm = 3.4\nlength_sd_mm = 0.5");
    for (k, (one, other)) in all.iter().zip(&lengths).enumerate() {
        assert!((one[1] - other[1]).abs() < 1e-12, "length of copy {k}");
        assert!((other[0] - 5.0 - 3.4 * k as f64).abs() < 1e-12 && (other[2] - 15.0).abs() < 1e-9);
    }
    let equal = row("count = 20\nspacing_mm = 3.4");
    assert_eq!(equal, row("count = 20\nspacing_mm = 3.4\nlength_sd_mm = 0.0"), "no scatter");
}

#[test]
fn scatter_that_no_row_can_have_is_refused() {
    let refused = |keys: &str, key: &str, says: &str| {
        let errors = Case::parse(&text(keys), "case.toml", Path::new("")).expect_err(keys);
        let told = errors.to_string();
        assert!(told.contains(&format!("crack[1].{key}")) && told.contains(says), "{keys}:\n{told}");
    };
    let rows = |keys: &str| format!("count = 5\nspacing_mm = 3.4\n{keys}");
    refused("length_sd_mm = 0.5", "length_sd_mm", "count is 1");
    refused(&rows("seed = 3"), "seed", "no standard deviation is given");
    refused(&rows("length_sd_mm = 2.1"), "length_sd_mm", "three standard deviations");
    refused(&rows("angle_sd_deg = 5.0"), "angle_sd_deg", "three standard deviations");
    refused(&rows("spacing_sd_mm = 1.2"), "spacing_sd_mm", "three standard deviations");
    refused(&rows("length_sd_mm = -1.0"), "length_sd_mm", "must be");
    let polyline =
        "[[crack]]\npoints_mm = [[900.0, 0.0], [904.0, -1.0]]\nfriction = 0.5\ncount = 3\nspacing_mm = 4.0\n";
    let errors = Case::parse(&text(&format!("{polyline}angle_sd_deg = 1.0")), "case.toml", Path::new(""));
    assert!(errors.unwrap_err().to_string().contains("applies to straight cracks"));
    let case = Case::parse(&text(&format!("{polyline}spacing_sd_mm = 0.3")), "case.toml", Path::new(""));
    assert_eq!(case.unwrap().cracks.cracks().len(), 4);
}
