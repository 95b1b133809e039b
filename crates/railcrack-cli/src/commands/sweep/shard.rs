//! Shards: parts of a study for several processes.

use std::str::FromStr;

/// Every `count`-th run of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 1 to `count`.
    index: usize,
    count: usize,
}

impl Shard {
    /// Whether run `number` (from 1) belongs to this part: those of part I of N are I, I + N, I + 2
    /// N, ….
    pub fn has(self, number: usize) -> bool {
        number % self.count == self.index % self.count
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("must be I/N with I from 1 to N, such as 1/4".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn parts_have_every_run_once() {
        let parts: Vec<Shard> = ["1/3", "2/3", "3/3"].iter().map(|text| text.parse().unwrap()).collect();
        for number in 1..=10 {
            let having: Vec<usize> = (0..3).filter(|&i| parts[i].has(number)).collect();
            assert_eq!(having, [(number - 1) % 3], "{number}");
        }
        for wrong in ["0/3", "4/3", "1", "1/0", "a/b", "-1/2", "1/3/5", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
