//! Accessors, checked before the crate's readers use them: these take what follows for granted, and panic where it is
//! not so.

use gltf::{
    Accessor,
    accessor::{
        DataType::{self, F32, U8, U16, U32},
        Dimensions::{self, Scalar, Vec2, Vec3, Vec4},
        sparse::Sparse,
    },
};

/// The elements that an accessor may have (glTF 2.0, section 3.7.2.1).
#[derive(Clone, Copy)]
pub(super) struct Elements(&'static [Dimensions], &'static [DataType]);

impl Elements {
    pub const FLOATS_3: Elements = Elements(&[Vec3], &[F32]);
    pub const FLOATS_4: Elements = Elements(&[Vec4], &[F32]);
    pub const COORDINATES: Elements = Elements(&[Vec2], &[F32, U8, U16]);
    pub const COLORS: Elements = Elements(&[Vec3, Vec4], &[F32, U8, U16]);
    pub const INDICES: Elements = Elements(&[Scalar], &[U8, U16, U32]);
}

/// Checks that an accessor holds elements of this kind, and that all its bytes are there.
pub(super) fn check(accessor: &Accessor<'_>, kind: Elements, what: &str, buffers: &[&[u8]]) -> Result<(), String> {
    let n = accessor.index();
    if !kind.0.contains(&accessor.dimensions()) || !kind.1.contains(&accessor.data_type()) {
        let (dimensions, data_type) = (accessor.dimensions(), accessor.data_type());
        return Err(format!("accessor {n} holds {dimensions:?} of {data_type:?}, which {what} cannot be"));
    }
    if accessor.count() == 0 {
        return Err(format!("accessor {n} has no elements"));
    }
    if let Some(view) = accessor.view() {
        elements(n, &view, accessor.offset(), accessor.count(), accessor.size(), buffers)?;
    }
    accessor.sparse().map_or(Ok(()), |sparse| check_sparse(accessor, &sparse, buffers))
}

/// Those of a sparse accessor: as many indices as values, each greater than the one before and less than the count.
fn check_sparse(accessor: &Accessor<'_>, sparse: &Sparse<'_>, buffers: &[&[u8]]) -> Result<(), String> {
    let (n, count) = (accessor.index(), sparse.count());
    if count == 0 || count > accessor.count() {
        return Err(format!("accessor {n} has {} elements and replaces {count} of them", accessor.count()));
    }
    let (indices, values) = (sparse.indices(), sparse.values());
    let width = indices.index_type().size();
    elements(n, &values.view(), values.offset(), count, accessor.size(), buffers)?;
    let (bytes, stride) = elements(n, &indices.view(), indices.offset(), count, width, buffers)?;
    let mut least = 0;
    for index in bytes.chunks(stride) {
        let index = index[..width].iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte));
        if index < least || index >= accessor.count() as u64 {
            return Err(format!("accessor {n} replaces its elements out of order or beyond its end"));
        }
        least = index + 1;
    }
    Ok(())
}

/// The bytes of `count` elements of `size` bytes in a view, and how far they lie apart.
fn elements<'a>(
    accessor: usize,
    view: &gltf::buffer::View<'_>,
    offset: usize,
    count: usize,
    size: usize,
    buffers: &[&'a [u8]],
) -> Result<(&'a [u8], usize), String> {
    let stride = view.stride().unwrap_or(size);
    if stride < size {
        return Err(format!("accessor {accessor} has elements of {size} bytes that lie {stride} apart"));
    }
    let find = || {
        let whole: &'a [u8] = buffers.get(view.buffer().index()).copied()?;
        let view = whole.get(view.offset()..view.offset().checked_add(view.length())?)?;
        let length = count.checked_sub(1)?.checked_mul(stride)?.checked_add(size)?;
        view.get(offset..offset.checked_add(length)?)
    };
    let bytes = find().ok_or_else(|| format!("accessor {accessor} reaches beyond its buffer"))?;
    Ok((bytes, stride))
}
