//! Groups of figures that vary the same input, a page each.

use crate::claim::Claim;

/// Figures that vary the same input.
pub struct FigureGroup {
    /// The input that they vary.
    title: &'static str,
    /// Their numbers, in order.
    pub figures: &'static [u8],
}

/// All groups, in the order of the paper.
pub const GROUPS: &[FigureGroup] = &[
    FigureGroup { title: "Validation", figures: &[13] },
    FigureGroup { title: "Wheel\u{2013}rail friction", figures: &[14, 15, 16] },
    FigureGroup { title: "Crack-face friction", figures: &[17, 18] },
    FigureGroup { title: "Inclination of the crack", figures: &[19, 20] },
    FigureGroup { title: "Residual stress", figures: &[21, 22, 23] },
    FigureGroup { title: "Two cracks", figures: &[24, 25] },
    FigureGroup { title: "Nine cracks", figures: &[27, 28, 29, 30] },
];

impl FigureGroup {
    fn ends(&self) -> (u8, u8) {
        let first = self.figures.first().copied().unwrap_or_default();
        (first, self.figures.last().copied().unwrap_or(first))
    }

    /// `Figs 14 to 16: wheel–rail friction`, the heading of its page.
    pub fn heading(&self) -> String {
        match self.ends() {
            (first, last) if first == last => format!("Fig. {first}: {}", self.title),
            (first, last) => format!("Figs {first} to {last}: {}", self.title),
        }
    }

    /// `paper-figs-14-16.md`, the file of its page.
    pub fn file(&self) -> String {
        match self.ends() {
            (first, last) if first == last => format!("paper-fig-{first}.md"),
            (first, last) => format!("paper-figs-{first}-{last}.md"),
        }
    }

    /// Whether some of its figures are among those computed.
    pub fn is_computed(&self, figures: &[u8]) -> bool {
        self.figures.iter().any(|figure| figures.contains(figure))
    }

    /// Whether `claim` is decided by its figures; of the figures of a claim the first counts.
    pub fn decides(&self, claim: &Claim) -> bool {
        claim.figures.first().is_some_and(|figure| self.figures.contains(figure))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::CLAIMS;
    use crate::figure::FIGURES;

    #[test]
    fn every_figure_and_statement_has_one_page() {
        for figure in FIGURES {
            assert_eq!(GROUPS.iter().filter(|group| group.figures.contains(&figure.number)).count(), 1);
        }
        for claim in CLAIMS.iter().copied().flatten() {
            assert_eq!(GROUPS.iter().filter(|group| group.decides(claim)).count(), 1, "{}", claim.id);
        }
    }
}
