//! The order of qualifiers.

use super::QualifierKind;

impl QualifierKind {
    /// Position in the order that section 4.7 and the grammar demand.
    pub fn rank(self) -> u8 {
        match self {
            QualifierKind::Layout(_) => 0,
            QualifierKind::Invariant => 1,
            QualifierKind::Flat | QualifierKind::Smooth => 2,
            QualifierKind::Centroid => 3,
            QualifierKind::Const => 4,
            QualifierKind::In | QualifierKind::Out | QualifierKind::Inout | QualifierKind::Uniform => 5,
            QualifierKind::Precision(_) => 6,
        }
    }
}
