//! Cracks and the running surface as a graph, whose loops are the outlines of pieces.

use crate::math::Vec2;

/// Graph of cracks and the running surface: points with identical bits are one node, and all points
/// of the surface are connected. It contains no loops: an edge that would close a loop yields its
/// outline instead.
#[derive(Debug, Clone, Default)]
pub(super) struct CrackGraph {
    points: Vec<Vec2>,
    edges: Vec<(usize, usize)>,
}

impl CrackGraph {
    /// Adds the edges along `points`, which must close no loop.
    pub fn add_line(&mut self, points: &[Vec2]) {
        for pair in points.windows(2) {
            let edge = (self.node(pair[0]), self.node(pair[1]));
            self.edges.push(edge);
        }
    }

    /// Adds the edge from `from` to `to`, or returns the outline that it closes, which begins with
    /// `to` and ends with `from`.
    pub fn close(&mut self, from: Vec2, to: Vec2) -> Option<Vec<Vec2>> {
        let (start, goal) = (self.node(from), self.node(to));
        let path = self.path(goal, start);
        if path.is_none() {
            self.edges.push((start, goal));
        }
        let outline: Vec<Vec2> = path?.into_iter().map(|node| self.points[node]).collect();
        // Of a path along the surface, only the ends are corners.
        let surface = |i: usize| outline.get(i).is_some_and(|p| p.y == 0.0);
        let corner = |i: &usize| *i == 0 || !(surface(i - 1) && surface(*i) && surface(i + 1));
        Some((0..outline.len()).filter(corner).map(|i| outline[i]).collect())
    }

    fn node(&mut self, point: Vec2) -> usize {
        if let Some(node) = self.points.iter().position(|&p| p == point) {
            return node;
        }
        self.points.push(point);
        let node = self.points.len() - 1;
        if point.y == 0.0 {
            // The surface is continuous: its points are chained to each other.
            if let Some(other) = self.points[..node].iter().position(|p| p.y == 0.0) {
                self.edges.push((other, node));
            }
        }
        node
    }

    /// The nodes from `start` to `goal`, both included, if they are connected.
    fn path(&self, start: usize, goal: usize) -> Option<Vec<usize>> {
        let mut before: Vec<Option<usize>> = vec![None; self.points.len()];
        before[start] = Some(start);
        let mut reached = vec![start];
        let mut next = 0;
        while next < reached.len() && before[goal].is_none() {
            let node = reached[next];
            for &(a, b) in &self.edges {
                let other = if a == node { b } else { a };
                if (a == node || b == node) && before[other].is_none() {
                    before[other] = Some(node);
                    reached.push(other);
                }
            }
            next += 1;
        }
        let mut path = vec![goal];
        let mut node = goal;
        while node != start {
            node = before[node]?;
            path.push(node);
        }
        path.reverse();
        Some(path)
    }
}
