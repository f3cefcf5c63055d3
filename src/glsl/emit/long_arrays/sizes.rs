//! Sizes of the types of a module, in scalars.

use naga::{ArraySize, Handle, Type, TypeInner, UniqueArena};

/// The sizes of types, by [`Handle::index`].
pub(super) struct Sizes {
    scalars: Vec<u32>,
    /// The number of scalars in the longest array within each type.
    longest: Vec<u32>,
}

impl Sizes {
    pub(super) fn new(types: &UniqueArena<Type>) -> Self {
        let mut sizes = Self { scalars: Vec::new(), longest: Vec::new() };
        for (_, ty) in types.iter() {
            let (scalars, longest) = match &ty.inner {
                TypeInner::Vector { size, .. } => (*size as u32, 0),
                TypeInner::Matrix { columns, rows, .. } => (*columns as u32 * *rows as u32, 0),
                TypeInner::Array { base, size: ArraySize::Constant(len), .. } => {
                    let scalars = sizes.scalars(*base).saturating_mul(len.get());
                    (scalars, scalars)
                }
                TypeInner::Struct { members, .. } => {
                    let scalars = members.iter().fold(0u32, |sum, m| sum.saturating_add(sizes.scalars(m.ty)));
                    (scalars, members.iter().map(|m| sizes.longest(m.ty)).max().unwrap_or(0))
                }
                _ => (1, 0),
            };
            sizes.scalars.push(scalars);
            sizes.longest.push(longest);
        }
        sizes
    }

    pub(super) fn scalars(&self, ty: Handle<Type>) -> u32 {
        self.scalars[ty.index()]
    }

    pub(super) fn longest(&self, ty: Handle<Type>) -> u32 {
        self.longest[ty.index()]
    }
}
