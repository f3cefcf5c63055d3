//! The faces of a cube, and the face for a direction: OpenGL ES 3.0, table 3.21.

/// A face of a cube. Its first row is at t = -1; seen from inside the cube the sides are upright.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// +x, layer 0.
    PlusX,
    /// -x, layer 1.
    MinusX,
    /// +y, layer 2.
    PlusY,
    /// -y, layer 3.
    MinusY,
    /// +z, layer 4.
    PlusZ,
    /// -z, layer 5.
    MinusZ,
}

impl Face {
    /// In the order of a texture's layers.
    pub const ALL: [Face; 6] = [Face::PlusX, Face::MinusX, Face::PlusY, Face::MinusY, Face::PlusZ, Face::MinusZ];

    /// The name on the command line and in the window.
    pub const fn name(self) -> &'static str {
        match self {
            Face::PlusX => "+x",
            Face::MinusX => "-x",
            Face::PlusY => "+y",
            Face::MinusY => "-y",
            Face::PlusZ => "+z",
            Face::MinusZ => "-z",
        }
    }

    /// Returns the direction through the face at `s` and `t`, each in -1 to 1, not normalised.
    pub const fn direction(self, s: f64, t: f64) -> [f64; 3] {
        match self {
            Face::PlusX => [1.0, -t, -s],
            Face::MinusX => [-1.0, -t, s],
            Face::PlusY => [s, 1.0, t],
            Face::MinusY => [s, -1.0, -t],
            Face::PlusZ => [s, -t, 1.0],
            Face::MinusZ => [-s, -t, -1.0],
        }
    }

    /// Returns the face that a direction points to: that of its longest axis, or the first of equal ones.
    pub fn of(direction: [f64; 3]) -> Face {
        let [x, y, z] = direction.map(f64::abs);
        let (axis, positive, negative) = if x >= y && x >= z {
            (direction[0], Face::PlusX, Face::MinusX)
        } else if y >= z {
            (direction[1], Face::PlusY, Face::MinusY)
        } else {
            (direction[2], Face::PlusZ, Face::MinusZ)
        };
        if axis >= 0.0 { positive } else { negative }
    }

    /// Returns the components of a vector along s, along t and along the axis of the face.
    pub const fn components(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Face::PlusX => [-z, -y, x],
            Face::MinusX => [z, -y, -x],
            Face::PlusY => [x, z, y],
            Face::MinusY => [x, -z, -y],
            Face::PlusZ => [x, -y, z],
            Face::MinusZ => [-x, -y, -z],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_point_to_their_face() {
        for face in Face::ALL {
            for (s, t) in [(0.0, 0.0), (0.9, -0.8), (-0.7, 0.95)] {
                let direction = face.direction(s, t);
                assert_eq!(Face::of(direction), face);
                assert_eq!(face.components(direction), [s, t, 1.0], "{face:?}");
            }
        }
    }
}
