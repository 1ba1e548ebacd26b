//! Variables in memory, in the order in which a file has them.

use super::circumstances::{write_numbers, write_scalars};
use super::dimensions::Dimensions;
use super::methods::write_methods;
use super::record::{Record, write_records};
use super::schema::{FORMAT, Root, values_name, write_root};
use super::values::{
    CAUSTIC_ORDER, SOLID_ANGLE, describe_caustic, describe_solid_angle, describe_values,
};
use super::{Kind, Store, Variable};
use crate::phase_table::{Slab, TableHeader};
use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

/// An attribute of a variable or of the whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Attribute {
    /// A text.
    Text(String),
    /// A number.
    Integer(i32),
}

/// Values of a variable, last dimension fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Double precision.
    F64(Vec<f64>),
    /// Integers.
    I32(Vec<i32>),
    /// Strings.
    Texts(Vec<String>),
    /// Not here, for they are large: those of the slabs, of their masks, and the solid angles.
    Elsewhere(Kind),
}

/// One variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Described {
    /// Its name.
    pub name: String,
    /// Names of its dimensions, the last fastest.
    pub dimensions: Vec<String>,
    /// Their lengths.
    pub shape: Vec<u64>,
    /// Its values.
    pub values: Values,
    /// Its attributes by their names, in the order of the file.
    pub attributes: Vec<(String, Attribute)>,
}

/// All of a table but its large arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// Attributes of the whole.
    pub attributes: Vec<(String, Attribute)>,
    /// Variables, coordinates of dimensions among them.
    pub variables: Vec<Described>,
}

/// Collects the few numbers that each slab of a table has beside its values.
#[derive(Clone, Debug)]
pub struct Describer {
    header: TableHeader,
    records: Vec<Option<Record>>,
    caustic: bool,
}

impl Describer {
    /// Of a table with this header.
    pub fn new(header: &TableHeader) -> Self {
        let records = vec![None; header.axes.wavelength.len()];
        Self { header: header.clone(), records, caustic: false }
    }

    /// The slab of the wavelength number `index`; one that the table does not have is not looked at.
    pub fn add(&mut self, index: usize, slab: &Slab) {
        if let Some(record) = self.records.get_mut(index) {
            *record = Some(Record::from(slab));
        }
        self.caustic |= slab.caustic_order.is_some();
    }

    /// The variables that the file of the table would have; `dated` says whether the time is told.
    pub fn finish(self, bit_round: Option<u8>, dated: bool) -> Description {
        let store = Memory::default();
        match self.write(&store, bit_round, dated) {
            Ok(()) => {}
            Err(never) => match never {},
        }
        let attributes = store.attributes.into_inner();
        let variables = store.variables.into_inner();
        let variables = variables.into_iter().map(|variable| variable.0.borrow().clone()).collect();
        Description { attributes, variables }
    }

    fn write(self, store: &Memory, bit_round: Option<u8>, dated: bool) -> Result<(), Infallible> {
        let header = &self.header;
        let root = Root { format: FORMAT, bit_round, dated, attributes: &[] };
        write_root(store, header, &root)?;
        let dimensions = Dimensions::create(store, &header.axes, header.quantity)?;
        let face = [header.axes.theta.len() as u64, header.axes.phi.len() as u64];
        let solid_angle = store.variable(SOLID_ANGLE, Kind::F32, &face)?;
        describe_solid_angle(&solid_angle, &dimensions)?;
        write_scalars(store, header, |_| false)?;
        write_numbers(store, &[Some(header.clone())], &[], &[])?;
        let count = self.records.len() as u64;
        let mut shape = vec![count];
        shape.extend(dimensions.element.as_ref().map(|_| header.quantity.elements() as u64));
        shape.extend(face);
        let values = store.variable(values_name(header.quantity), Kind::F32, &shape)?;
        describe_values(&values, &dimensions, &[], header.quantity, bit_round)?;
        if self.caustic {
            let mask = store.variable(CAUSTIC_ORDER, Kind::U8, &[count, face[0], face[1]])?;
            describe_caustic(&mask, &dimensions, &[])?;
        }
        write_records(store, &self.records, &[&dimensions.wavelength], &[count])?;
        write_methods(store, &header.axes.wavelength, &self.records)?;
        store.attribute_integer("complete", 1)
    }
}

/// Variables being collected.
#[derive(Debug, Default)]
struct Memory {
    attributes: RefCell<Vec<(String, Attribute)>>,
    variables: RefCell<Vec<InMemory>>,
}

/// A variable, shared with the store that it is in.
#[derive(Clone, Debug)]
struct InMemory(Rc<RefCell<Described>>);

impl Store for Memory {
    type Variable = InMemory;
    type Error = Infallible;

    fn attribute(&self, name: &str, text: &str) -> Result<(), Infallible> {
        self.attributes.borrow_mut().push((name.into(), Attribute::Text(text.into())));
        Ok(())
    }

    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), Infallible> {
        self.attributes.borrow_mut().push((name.into(), Attribute::Integer(value)));
        Ok(())
    }

    fn variable(&self, name: &str, kind: Kind, shape: &[u64]) -> Result<InMemory, Infallible> {
        let variable = InMemory(Rc::new(RefCell::new(Described {
            name: name.into(),
            dimensions: Vec::new(),
            shape: shape.to_vec(),
            values: Values::Elsewhere(kind),
            attributes: Vec::new(),
        })));
        self.variables.borrow_mut().push(variable.clone());
        Ok(variable)
    }
}

impl Variable for InMemory {
    type Error = Infallible;

    fn write_numbers(&self, values: &[f64]) -> Result<(), Infallible> {
        self.0.borrow_mut().values = Values::F64(values.to_vec());
        Ok(())
    }

    fn write_integers(&self, values: &[i32]) -> Result<(), Infallible> {
        self.0.borrow_mut().values = Values::I32(values.to_vec());
        Ok(())
    }

    fn write_texts(&self, texts: &[String]) -> Result<(), Infallible> {
        self.0.borrow_mut().values = Values::Texts(texts.to_vec());
        Ok(())
    }

    fn attribute(&self, name: &str, text: &str) -> Result<(), Infallible> {
        self.0.borrow_mut().attributes.push((name.into(), Attribute::Text(text.into())));
        Ok(())
    }

    fn attribute_integer(&self, name: &str, value: i32) -> Result<(), Infallible> {
        self.0.borrow_mut().attributes.push((name.into(), Attribute::Integer(value)));
        Ok(())
    }

    fn make_scale(&self, name: &str) -> Result<(), Infallible> {
        self.0.borrow_mut().dimensions = vec![name.into()];
        Ok(())
    }

    fn attach(&self, scales: &[&Self]) -> Result<(), Infallible> {
        let names = scales.iter().map(|scale| scale.0.borrow().name.clone()).collect();
        self.0.borrow_mut().dimensions = names;
        Ok(())
    }
}
