//! Arenas and pools: 4-byte ids, lists of children, and the impls that add both to an owner.

use std::{fmt, marker::PhantomData};

/// Declares 4-byte ids with a niche, so that `Option<Id>` takes 4 bytes as well.
macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(::std::num::NonZeroU32);

        impl $name {
            /// Returns the id of element `index` of its arena.
            #[inline]
            pub fn new(index: usize) -> Self {
                // Arenas stay far below 2^32 elements: sources are bounded by 2^32 bytes, expansion by the
                // preprocessor.
                Self(::std::num::NonZeroU32::new(index as u32 + 1).expect("fewer than 2^32 - 1 nodes"))
            }

            /// Returns the position in the arena, from 0.
            #[inline]
            pub fn index(self) -> usize {
                self.0.get() as usize - 1
            }
        }

        impl ::std::fmt::Debug for $name {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                write!(f, "{}({})", stringify!($name), self.index())
            }
        }
    )*};
}
pub(crate) use ids;

/// Children: a range of the pool of `T` in its owner ([`super::Ast`] or `hir::Module`). Read with `&owner[list]`.
pub struct List<T> {
    start: u32,
    len: u32,
    of: PhantomData<fn() -> T>,
}

impl<T> List<T> {
    pub const EMPTY: Self = Self { start: 0, len: 0, of: PhantomData };

    #[inline]
    pub fn new(start: usize, len: usize) -> Self {
        Self { start: start as u32, len: len as u32, of: PhantomData }
    }

    #[inline]
    pub fn len(self) -> usize {
        self.len as usize
    }

    #[inline]
    pub fn is_empty(self) -> bool {
        self.len == 0
    }

    /// Returns the range in the pool.
    #[inline]
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.start as usize + self.len as usize
    }
}

impl<T> Clone for List<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for List<T> {}
impl<T> Default for List<T> {
    fn default() -> Self {
        Self::EMPTY
    }
}
impl<T> PartialEq for List<T> {
    fn eq(&self, other: &Self) -> bool {
        self.start == other.start && self.len == other.len
    }
}
impl<T> Eq for List<T> {}
impl<T> fmt::Debug for List<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.range())
    }
}

/// Copies a list with spare capacity. A plain clone has none, so its first push would copy everything again.
pub(crate) fn with_room<T: Copy>(list: &[T]) -> Vec<T> {
    let mut copy = Vec::with_capacity(list.len() + list.len() / 2 + 16);
    copy.extend_from_slice(list);
    copy
}

/// A type of which `Owner` has a pool for [`List`]s.
pub trait Pooled<Owner>: Copy {
    fn pool(owner: &Owner) -> &Vec<Self>;
    fn pool_mut(owner: &mut Owner) -> &mut Vec<Self>;
}

/// Implements indexing for an owner's arenas (`id => node in field`) and pools (`element in field`).
macro_rules! arenas {
    ($owner:ty; $($id:ty => $node:ty, $field:ident;)* @pools $($elem:ty, $pool:ident;)*) => {
        $(impl ::std::ops::Index<$id> for $owner {
            type Output = $node;
            #[inline]
            fn index(&self, id: $id) -> &$node {
                &self.$field[id.index()]
            }
        }
        impl ::std::ops::IndexMut<$id> for $owner {
            #[inline]
            fn index_mut(&mut self, id: $id) -> &mut $node {
                &mut self.$field[id.index()]
            }
        })*
        $(impl $crate::ast::Pooled<$owner> for $elem {
            #[inline]
            fn pool(owner: &$owner) -> &Vec<Self> {
                &owner.$pool
            }
            #[inline]
            fn pool_mut(owner: &mut $owner) -> &mut Vec<Self> {
                &mut owner.$pool
            }
        })*
        impl<T: $crate::ast::Pooled<$owner>> ::std::ops::Index<$crate::ast::List<T>> for $owner {
            type Output = [T];
            #[inline]
            fn index(&self, list: $crate::ast::List<T>) -> &[T] {
                &T::pool(self)[list.range()]
            }
        }
        impl<T: $crate::ast::Pooled<$owner>> ::std::ops::IndexMut<$crate::ast::List<T>> for $owner {
            #[inline]
            fn index_mut(&mut self, list: $crate::ast::List<T>) -> &mut [T] {
                &mut T::pool_mut(self)[list.range()]
            }
        }
        impl $owner {
            /// Stores children and returns their list. Collect them in a scratch stack first: lists nest.
            #[inline]
            pub fn list<T: $crate::ast::Pooled<$owner>>(&mut self, items: &[T]) -> $crate::ast::List<T> {
                let pool = T::pool_mut(self);
                let start = pool.len();
                pool.extend_from_slice(items);
                $crate::ast::List::new(start, items.len())
            }
        }
    };
}
pub(crate) use arenas;
