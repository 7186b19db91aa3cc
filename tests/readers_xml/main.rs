//! VTK XML files, written by VTK itself (scripts/fixtures.py), are read as VTK would; broken ones are refused.

mod checks;
mod damage;
mod values;
