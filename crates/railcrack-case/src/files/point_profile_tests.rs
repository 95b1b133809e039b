//! Profiles in all formats.

use super::*;

fn read(text: &str, is: Profiled, axes: Option<ProfileAxes>) -> Result<Profile, String> {
    let reading = ProfileReading { smoothing: 1.0, is, axes };
    parse(&Source::new("p", text), reading).map_err(|fault| fault.message)
}

fn refused(text: &str, is: Profiled) -> String {
    read(text, is, None).unwrap_err()
}

fn rows(heights: fn(f64) -> f64, separator: &str) -> String {
    (-35..=60).map(|i| format!("{i}{separator}{}\n", heights(f64::from(i)))).collect()
}

/// A rail head that falls to negative y, and a wheel with its flange there.
fn head(y: f64) -> f64 {
    y * y / 600.0 - y / 40.0
}

fn wheel(y: f64) -> f64 {
    -0.025 * y + if y < -25.0 { 0.2 * (y + 25.0).powi(2) } else { 0.0 }
}

#[test]
fn refused_profiles() {
    let csv = |heights| format!("y_mm,z_mm\n{}", rows(heights, ","));
    assert!(
        read(&csv(head), Profiled::Rail, None).is_ok() && read(&csv(wheel), Profiled::Wheel, None).is_ok()
    );
    let says = refused(&csv(|y| -head(y)), Profiled::Rail);
    assert!(says.contains("z_mm is measured downwards"), "{says}");
    let says = refused(&csv(|y| -wheel(y)), Profiled::Wheel);
    assert!(says.contains("the profile rises 2") && says.contains("the flange lies below"), "{says}");
    assert!(
        refused("y_mm,z_mm\n0,0\n1,0\n", Profiled::Wheel).contains("2 points; a profile needs at least 10")
    );
    assert!(
        refused("y_mm,z_mm\n0,0\n9,0\n", Profiled::Wheel).contains("row 2 lies 9.000 mm from the row before")
    );
    assert!(refused("y_mm,height\n0,0\n", Profiled::Wheel).contains("unknown column `height`"));
    assert!(refused("y_mm,z_mm\n0,x\n", Profiled::Wheel).contains("`z_mm = x`: must be a number"));
    let metres: String = (-35..=35).map(|i| format!("{},0.0\n", 1e-3 * f64::from(i))).collect();
    assert!(refused(&format!("y_mm,z_mm\n{metres}"), Profiled::Rail).contains("in metres?"));
}

#[test]
fn every_format_gives_the_same_profile() {
    let simpack = |head: &str, points: &str| {
        format!(
            "header.begin\n type = 1\nheader.end\nspline.begin\n{head}point.begin\n{points}point.end\nspline.end\n"
        )
    };
    let miniprof = |points: &str| format!("FileName=a.whl\nColumnDef=X,Y,*\n\n{points}");
    let want = read(&format!("y_mm,z_mm\n{}", rows(wheel, ",")), Profiled::Wheel, None).unwrap();
    for (text, axes) in [
        (format!("y_mm;z_mm\n[mm];[mm]\n{}", rows(wheel, ";")), None),
        (format!("! worn\n{}", rows(wheel, " ")), None),
        (format!("! worn\n{}", rows(|y| -wheel(y), " ")), Some(ProfileAxes::ZUp)),
        (simpack("", &rows(wheel, " ")), None),
        (simpack("mirror.z = 1\nunits.len.f = 1000\n", &rows(|y| -wheel(y), "\t")), None),
        (miniprof(&rows(wheel, " ")), None),
        (miniprof(&rows(|y| -wheel(y), " ")), None),
    ] {
        assert_eq!(read(&text, Profiled::Wheel, axes).as_ref(), Ok(&want), "{text}");
    }
    let mirrored = read(&rows(wheel, " "), Profiled::Wheel, Some(ProfileAxes::Mirrored)).unwrap();
    let ([y, _], [other, _]) = (want.flange().unwrap(), mirrored.flange().unwrap());
    assert!((y + 35.0).abs() < 0.1 && (other - 35.0).abs() < 0.1, "{y}, {other}");
    // What a CSV file and two columns say of themselves holds.
    assert!(refused(&rows(|y| -wheel(y), " "), Profiled::Wheel).contains("the flange lies below"));
    assert!(refused(&simpack("", &rows(head, " ")), Profiled::Rail).contains("it is a wheel, not a rail"));
}
