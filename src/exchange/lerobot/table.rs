//! Tables in Parquet files: columns of numbers, texts, pictures, and arrays of these with one shape in all rows.

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Scalars of a column, row-major.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
    /// Integers.
    I64(Vec<i64>),
    /// Truth values.
    Bool(Vec<bool>),
    /// Texts.
    Text(Vec<String>),
    /// PNG files.
    Png(Vec<Vec<u8>>),
}

impl Cells {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Cells::F32(v) => v.len(),
            Cells::F64(v) => v.len(),
            Cells::I64(v) => v.len(),
            Cells::Bool(v) => v.len(),
            Cells::Text(v) => v.len(),
            Cells::Png(v) => v.len(),
        }
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Shape of a row; empty for one scalar a row.
    pub row: Vec<usize>,
    /// Its scalars.
    pub cells: Cells,
}

impl Column {
    /// A column of one scalar a row.
    pub fn scalars(name: &str, cells: Cells) -> Self {
        Column { name: name.to_owned(), row: Vec::new(), cells }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        match &self.cells {
            Cells::F32(v) => 4 * v.len(),
            Cells::F64(v) => 8 * v.len(),
            Cells::I64(v) => 8 * v.len(),
            Cells::Bool(v) => v.len(),
            Cells::Text(v) => v.iter().map(String::len).sum(),
            Cells::Png(v) => v.iter().map(Vec::len).sum(),
        }
    }

    /// Adds the rows of another column of the same form.
    pub fn append(&mut self, other: Column) {
        match (&mut self.cells, other.cells) {
            (Cells::F32(a), Cells::F32(b)) => a.extend(b),
            (Cells::F64(a), Cells::F64(b)) => a.extend(b),
            (Cells::I64(a), Cells::I64(b)) => a.extend(b),
            (Cells::Bool(a), Cells::Bool(b)) => a.extend(b),
            (Cells::Text(a), Cells::Text(b)) => a.extend(b),
            (Cells::Png(a), Cells::Png(b)) => a.extend(b),
            _ => unreachable!("columns are compared before they are appended"),
        }
    }

    fn schema(&self) -> Result<Type> {
        let name = if self.row.is_empty() { &self.name[..] } else { "element" };
        let mut out = match &self.cells {
            Cells::F32(_) => leaf(name, Physical::FLOAT, None)?,
            Cells::F64(_) => leaf(name, Physical::DOUBLE, None)?,
            Cells::I64(_) => leaf(name, Physical::INT64, None)?,
            Cells::Bool(_) => leaf(name, Physical::BOOLEAN, None)?,
            Cells::Text(_) => leaf(name, Physical::BYTE_ARRAY, Some(LogicalType::String))?,
            Cells::Png(_) => {
                let bytes = leaf("bytes", Physical::BYTE_ARRAY, None)?;
                let path = leaf("path", Physical::BYTE_ARRAY, Some(LogicalType::String))?;
                group(name, Repetition::OPTIONAL, None, vec![bytes, path])?
            }
        };
        for level in 0..self.row.len() {
            let name = if level + 1 == self.row.len() { &self.name[..] } else { "element" };
            let list = group("list", Repetition::REPEATED, None, vec![out])?;
            out = group(name, Repetition::OPTIONAL, Some(LogicalType::List), vec![list])?;
        }
        Ok(out)
    }
}

fn leaf(name: &str, physical: Physical, logical: Option<LogicalType>) -> Result<Type> {
    let builder = Type::primitive_type_builder(name, physical);
    builder.with_repetition(Repetition::OPTIONAL).with_logical_type(logical).build()
}

fn group(
    name: &str,
    repetition: Repetition,
    logical: Option<LogicalType>,
    fields: Vec<Type>,
) -> Result<Type> {
    let fields: Vec<TypePtr> = fields.into_iter().map(Arc::new).collect();
    let builder = Type::group_type_builder(name).with_repetition(repetition);
    builder.with_logical_type(logical).with_fields(fields).build()
}

/// A Parquet file that is being written, under another name until it is complete.
pub struct Table {
    path: PathBuf,
    writer: SerializedFileWriter<BufWriter<File>>,
}

impl Table {
    /// Makes a file for columns of these forms, with texts that describe it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: &Path, columns: &[Column], texts: &[(&str, String)]) -> Result<Self> {
        let fields = columns.iter().map(|column| column.schema().map(Arc::new)).collect::<Result<_>>()?;
        let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
        let texts =
            texts.iter().map(|(name, text)| KeyValue::new((*name).to_owned(), text.clone())).collect();
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_key_value_metadata(Some(texts))
            .set_created_by(concat!("robohive ", env!("CARGO_PKG_VERSION")).to_owned())
            .build();
        let file = BufWriter::new(File::create(unfinished(path))?);
        let writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))?;
        Ok(Table { path: path.to_owned(), writer })
    }

    /// Adds rows, as one row group. The columns have the forms and the order of those that the file was made for.
    ///
    /// # Errors
    /// Writing fails.
    pub fn write(&mut self, columns: &[Column]) -> Result<()> {
        let mut rows = self.writer.next_row_group()?;
        for column in columns {
            match &column.cells {
                Cells::F32(v) => put::<FloatType>(&mut rows, v, column)?,
                Cells::F64(v) => put::<DoubleType>(&mut rows, v, column)?,
                Cells::I64(v) => put::<Int64Type>(&mut rows, v, column)?,
                Cells::Bool(v) => put::<BoolType>(&mut rows, v, column)?,
                Cells::Text(v) => {
                    let texts: Vec<ByteArray> =
                        v.iter().map(|text| text.as_bytes().to_vec().into()).collect();
                    put::<ByteArrayType>(&mut rows, &texts, column)?;
                }
                Cells::Png(v) => {
                    let files: Vec<ByteArray> = v.iter().map(|file| file.clone().into()).collect();
                    put_levels::<ByteArrayType>(&mut rows, &files, &vec![2; v.len()], None)?;
                    // A picture in the file has no path.
                    put_levels::<ByteArrayType>(&mut rows, &[], &vec![1; v.len()], None)?;
                }
            }
        }
        rows.close()?;
        Ok(())
    }

    /// Bytes written to the file.
    pub fn bytes(&self) -> usize {
        self.writer.bytes_written()
    }

    /// Completes the file.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<()> {
        self.writer.close()?;
        Ok(std::fs::rename(unfinished(&self.path), &self.path)?)
    }
}

/// The name of a file until it is complete, which nobody takes for a table.
fn unfinished(path: &Path) -> PathBuf {
    path.with_extension("parquet.new")
}

/// Writes the scalars of a column without missing values.
fn put<T: DataType>(
    rows: &mut SerializedRowGroupWriter<'_, BufWriter<File>>,
    values: &[T::T],
    column: &Column,
) -> Result<()> {
    // Every list and every scalar could be missing.
    let defined = vec![2 * column.row.len() as i16 + 1; values.len()];
    let nested = (!column.row.is_empty()).then(|| repetitions(&column.row, values.len()));
    put_levels::<T>(rows, values, &defined, nested.as_deref())
}

fn put_levels<T: DataType>(
    rows: &mut SerializedRowGroupWriter<'_, BufWriter<File>>,
    values: &[T::T],
    defined: &[i16],
    nested: Option<&[i16]>,
) -> Result<()> {
    let Some(mut out) = rows.next_column()? else {
        return Err(parquet::errors::ParquetError::General("a column more than the file has".into()));
    };
    out.typed::<T>().write_batch(values, Some(defined), nested)?;
    out.close()
}

/// For each of `count` scalars of rows of a shape the list that it is the next element of: 0 begins a row.
fn repetitions(row: &[usize], count: usize) -> Vec<i16> {
    let width: usize = row.iter().product();
    let one: Vec<i16> = (0..width)
        .map(|i| {
            let (mut level, mut block) = (row.len() as i16, 1);
            for &axis in row.iter().rev() {
                block *= axis;
                if i % block != 0 {
                    break;
                }
                level -= 1;
            }
            level
        })
        .collect();
    one.into_iter().cycle().take(count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_say_where_lists_begin() {
        assert_eq!(repetitions(&[3], 6), [0, 1, 1, 0, 1, 1]);
        assert_eq!(repetitions(&[2, 1, 2], 4), [0, 3, 1, 3]);
        assert_eq!(repetitions(&[3, 1, 1], 3), [0, 1, 1]);
    }
}
