//! Accessors: typed elements with their bytes, checked before one of them is read.

use super::{
    buffers::Buffers,
    document::{Accessor, Dimensions, Index, Root},
};
use crate::mesh::trouble::ModelError;
use Component::{F32, I8, I16, U8, U16, U32};
use Dimensions::{Mat4, Scalar, Vec2, Vec3, Vec4};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(number: u32) -> Option<Component> {
        [(5120, I8), (5121, U8), (5122, I16), (5123, U16), (5125, U32), (5126, F32)]
            .into_iter()
            .find_map(|(n, component)| (n == number).then_some(component))
    }

    fn bytes(self) -> usize {
        match self {
            I8 | U8 => 1,
            I16 | U16 => 2,
            U32 | F32 => 4,
        }
    }

    fn read(self, bytes: &[u8]) -> f32 {
        match (self, bytes) {
            (I8, &[a, ..]) => f32::from(a as i8),
            (U8, &[a, ..]) => f32::from(a),
            (I16, &[a, b, ..]) => f32::from(i16::from_le_bytes([a, b])),
            (U16, &[a, b, ..]) => f32::from(u16::from_le_bytes([a, b])),
            (U32, &[a, b, c, d, ..]) => u32::from_le_bytes([a, b, c, d]) as f32,
            (F32, &[a, b, c, d, ..]) => f32::from_le_bytes([a, b, c, d]),
            _ => 0.0,
        }
    }

    /// Returns the value of a normalised integer (section 3.6.2.2).
    fn normalized(self, x: f32) -> f32 {
        match self {
            I8 => (x / 127.0).max(-1.0),
            U8 => x / 255.0,
            I16 => (x / 32767.0).max(-1.0),
            U16 => x / 65535.0,
            U32 | F32 => x,
        }
    }
}

/// The interpretation of integers.
#[derive(Clone, Copy)]
enum Integers {
    /// As plain numbers.
    Plain,
    /// As normalised values: the attribute has no other integers, whether its accessor says so or not.
    Normalized,
    /// As specified by the accessor.
    AsSaid,
}

/// The elements that an accessor may have (sections 3.7.2.1, 3.7.2.2 and 3.7.3.3).
#[derive(Clone, Copy)]
pub(super) struct Elements {
    dimensions: &'static [Dimensions],
    components: &'static [Component],
    /// The additional components that `KHR_mesh_quantization` allows.
    quantized: &'static [Component],
    integers: Integers,
}

const fn elements(dimensions: &'static [Dimensions], components: &'static [Component]) -> Elements {
    Elements { dimensions, components, quantized: &[], integers: Integers::Normalized }
}

impl Elements {
    pub(super) const POSITIONS: Elements =
        Elements { quantized: &[I8, U8, I16, U16], integers: Integers::AsSaid, ..elements(&[Vec3], &[F32]) };
    pub(super) const NORMALS: Elements = Elements { quantized: &[I8, I16], ..elements(&[Vec3], &[F32]) };
    pub(super) const TANGENTS: Elements = Elements { quantized: &[I8, I16], ..elements(&[Vec4], &[F32]) };
    /// Also those of morph targets: normalised if the file is not quantised.
    pub(super) const COORDINATES: Elements =
        Elements { quantized: &[I8, I16], integers: Integers::AsSaid, ..elements(&[Vec2], &[F32, U8, U16]) };
    pub(super) const COLORS: Elements = elements(&[Vec3, Vec4], &[F32, U8, U16]);
    pub(super) const COORDINATE_SHIFTS: Elements = elements(&[Vec2], &[F32, I8, U8, I16, U16]);
    pub(super) const COLOR_SHIFTS: Elements = elements(&[Vec3, Vec4], &[F32, I8, U8, I16, U16]);
    pub(super) const JOINTS: Elements = Elements { integers: Integers::Plain, ..elements(&[Vec4], &[U8, U16]) };
    pub(super) const WEIGHTS: Elements = elements(&[Vec4], &[F32, U8, U16]);
    pub(super) const INDICES: Elements = Elements { integers: Integers::Plain, ..elements(&[Scalar], &[U8, U16, U32]) };
    pub(super) const MATRICES: Elements = elements(&[Mat4], &[F32]);
    pub(super) const PLACES: Elements = elements(&[Vec3], &[F32]);
    pub(super) const TURNS: Elements = elements(&[Vec4], &[F32, I8, I16]);
}

/// The file's accessors and their bytes.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub root: &'a Root<'a>,
    pub buffers: &'a Buffers<'a>,
    pub is_quantized: bool,
}

/// The elements of an accessor, all of whose bytes exist.
pub(super) struct Values<'a> {
    bytes: Bytes<'a>,
    pub count: usize,
    component: Component,
    width: usize,
    is_normalized: bool,
    sparse: Option<SparseValues<'a>>,
}

/// The elements that a sparse accessor replaces.
struct SparseValues<'a> {
    count: usize,
    places: Bytes<'a>,
    place: Component,
    values: Bytes<'a>,
}

/// Elements with a stride in bytes. Without bytes, all are zeros.
#[derive(Clone, Copy)]
struct Bytes<'a> {
    all: Option<&'a [u8]>,
    stride: usize,
    size: usize,
}

impl<'a> Bytes<'a> {
    fn element(&self, i: usize) -> &'a [u8] {
        self.all.map_or(&[], |all| &all[i * self.stride..][..self.size])
    }
}

impl<'a> Source<'a> {
    /// Returns the number of an accessor's elements that have no bytes in the file. Its index must be in range.
    pub(super) fn zeros(&self, index: Index) -> u64 {
        let accessor = &self.root.accessors[index as usize];
        match (accessor.buffer_view, &accessor.sparse) {
            (Some(_), _) => 0,
            (None, Some(sparse)) => accessor.count.saturating_sub(sparse.count),
            (None, None) => accessor.count,
        }
    }

    /// Returns the elements of an accessor, which must have this kind. Its index must be in range.
    pub(super) fn values(&self, index: Index, kind: Elements, what: &str) -> Result<Values<'a>, ModelError> {
        let accessor = &self.root.accessors[index as usize];
        let number = accessor.component_type;
        let Some(component) = Component::of(number) else {
            let why = format!("accessor {index} has the componentType {number}, which glTF 2.0 does not know");
            return Err(ModelError::broken(why));
        };
        let dimensions = accessor.dimensions;
        let is_quantized = kind.quantized.contains(&component);
        let fits = kind.components.contains(&component) || is_quantized && self.is_quantized;
        if !kind.dimensions.contains(&dimensions) || !fits {
            let without = match is_quantized && !self.is_quantized {
                true => " without KHR_mesh_quantization",
                false => "",
            };
            return Err(ModelError::broken(format!(
                "accessor {index} has {dimensions:?} of {component:?}, which {what} cannot have{without}"
            )));
        }
        if accessor.count == 0 {
            return Err(ModelError::broken(format!("accessor {index} has no elements")));
        }
        let width = match dimensions {
            Scalar => 1,
            Vec2 => 2,
            Vec3 => 3,
            Vec4 => 4,
            _ => 16,
        };
        let is_normalized = match kind.integers {
            Integers::Plain => false,
            Integers::Normalized => true,
            Integers::AsSaid => accessor.normalized || !self.is_quantized,
        };
        let size = width * component.bytes();
        let count = accessor.count;
        let bytes = match accessor.buffer_view {
            Some(view) => self.elements(index, view, accessor.byte_offset, count, size)?,
            None => Bytes { all: None, stride: 0, size },
        };
        let sparse = self.sparse(index, accessor, size)?;
        Ok(Values { bytes, count: count as usize, component, width, is_normalized, sparse })
    }

    /// Returns the elements that a sparse accessor replaces: as many indices as values, each greater than the previous
    /// one and less than the count (section 3.6.2.3).
    fn sparse(&self, index: Index, accessor: &Accessor, size: usize) -> Result<Option<SparseValues<'a>>, ModelError> {
        let Some(sparse) = &accessor.sparse else { return Ok(None) };
        let (all, count) = (accessor.count, sparse.count);
        if count > all {
            return Err(ModelError::broken(format!(
                "accessor {index} has {all} elements and replaces {count} of them"
            )));
        }
        let place = Component::of(sparse.indices.component_type).filter(|c| [U8, U16, U32].contains(c));
        let Some(place) = place else {
            let number = sparse.indices.component_type;
            return Err(ModelError::broken(format!(
                "accessor {index} replaces elements by indices of the componentType {number}"
            )));
        };
        let values = self.elements(index, sparse.values.buffer_view, sparse.values.byte_offset, count, size)?;
        let (view, offset) = (sparse.indices.buffer_view, sparse.indices.byte_offset);
        let places = self.elements(index, view, offset, count, place.bytes())?;
        let replaced = SparseValues { count: count as usize, places, place, values };
        let mut least = 0;
        for at in (0..replaced.count).map(|i| replaced.at(i)) {
            if at < least || at >= all {
                return Err(ModelError::broken(format!(
                    "accessor {index} replaces its elements out of order or beyond its end"
                )));
            }
            least = at + 1;
        }
        Ok(Some(replaced))
    }

    /// Returns the bytes of `count` elements of `size` bytes in a view.
    fn elements(
        &self,
        index: Index,
        view: Index,
        offset: u64,
        count: u64,
        size: usize,
    ) -> Result<Bytes<'a>, ModelError> {
        let stride = self.root.buffer_views[view as usize].byte_stride.unwrap_or(size as u64);
        if stride < size as u64 {
            let why = format!("accessor {index} has elements of {size} bytes with a stride of {stride}");
            return Err(ModelError::broken(why));
        }
        let view = self.buffers.view(self.root, view)?;
        let find = || {
            let length = match count.checked_sub(1) {
                Some(before) => before.checked_mul(stride)?.checked_add(size as u64)?,
                None => 0,
            };
            view.get(usize::try_from(offset).ok()?..usize::try_from(offset.checked_add(length)?).ok()?)
        };
        let all = find().ok_or_else(|| ModelError::broken(format!("accessor {index} reaches beyond its buffer")))?;
        Ok(Bytes { all: Some(all), stride: stride as usize, size })
    }
}

impl SparseValues<'_> {
    fn at(&self, i: usize) -> u64 {
        self.places.element(i)[..self.place.bytes()].iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
    }
}

impl<'a> Values<'a> {
    /// Returns the bytes of each element, in order; empty for zeros.
    fn raw(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        let mut next = 0;
        (0..self.count).map(move |i| match &self.sparse {
            Some(sparse) if next < sparse.count && sparse.at(next) == i as u64 => {
                next += 1;
                sparse.values.element(next - 1)
            }
            _ => self.bytes.element(i),
        })
    }

    /// Returns each element as floats, with missing components from `rest`.
    pub(super) fn floats<const N: usize>(&self, rest: [f32; N]) -> impl Iterator<Item = [f32; N]> + '_ {
        let width = self.width.min(N);
        self.raw().map(move |bytes| {
            let mut element = rest;
            for (n, x) in element[..width].iter_mut().enumerate() {
                let plain = self.component.read(bytes.get(n * self.component.bytes()..).unwrap_or_default());
                *x = if self.is_normalized { self.component.normalized(plain) } else { plain };
            }
            element
        })
    }

    /// Returns the first component of each element, of an accessor of unsigned integers.
    pub(super) fn integers(&self) -> impl Iterator<Item = u32> + '_ {
        let width = self.component.bytes();
        self.raw().map(move |bytes| bytes.iter().take(width).rev().fold(0, |sum, byte| sum << 8 | u32::from(*byte)))
    }

    /// Returns whether they are stored as integers.
    pub(super) fn are_integers(&self) -> bool {
        self.component != F32
    }

    /// Returns the maximum index of this type: some programs use it to restart a strip.
    pub(super) fn restart(&self) -> u32 {
        match self.component {
            U8 => u32::from(u8::MAX),
            U16 => u32::from(u16::MAX),
            _ => u32::MAX,
        }
    }
}
