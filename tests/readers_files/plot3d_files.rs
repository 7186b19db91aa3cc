//! PLOT3D files of every variant, made here, and the real ones.

use glam::DVec3;
use tetralux::mesh::{ArrayChoice, ReadOptions, Topology, plot3d};
use tetralux::space::{Bounds, Interval};

use super::{data, difference};

/// Writes PLOT3D files of a given variant.
pub struct Plot3d {
    pub little: bool,
    pub records: bool,
    pub counted: bool,
    pub double: bool,
    pub iblank: bool,
    pub dims: Vec<[usize; 3]>,
}

impl Plot3d {
    fn int(&self, out: &mut Vec<u8>, value: i32) {
        out.extend(if self.little { value.to_le_bytes() } else { value.to_be_bytes() });
    }

    fn reals(&self, out: &mut Vec<u8>, values: impl IntoIterator<Item = f64>) {
        for v in values {
            match (self.double, self.little) {
                (true, true) => out.extend(v.to_le_bytes()),
                (true, false) => out.extend(v.to_be_bytes()),
                (false, true) => out.extend((v as f32).to_le_bytes()),
                (false, false) => out.extend((v as f32).to_be_bytes()),
            }
        }
    }

    fn record(&self, out: &mut Vec<u8>, data: Vec<u8>) {
        let mark = |out: &mut Vec<u8>| {
            if self.records {
                self.int(out, data.len() as i32);
            }
        };
        mark(out);
        out.extend(&data);
        mark(out);
    }

    fn header(&self) -> Vec<u8> {
        let (mut out, mut sizes) = (Vec::new(), Vec::new());
        if self.counted {
            let mut count = Vec::new();
            self.int(&mut count, self.dims.len() as i32);
            self.record(&mut out, count);
        }
        self.dims.iter().flatten().for_each(|n| self.int(&mut sizes, *n as i32));
        self.record(&mut out, sizes);
        out
    }

    /// x, y, z are the lattice's; IBLANK is 0 at the block's first point, else 1 and -1 in turns.
    pub fn grid(&self) -> Vec<u8> {
        let mut out = self.header();
        for n in &self.dims {
            let (mut data, count) = (Vec::new(), n.iter().product::<usize>());
            self.reals(&mut data, (0..count).map(|i| (i % n[0]) as f64));
            self.reals(&mut data, (0..count).map(|i| (i / n[0] % n[1]) as f64));
            self.reals(&mut data, (0..count).map(|i| (i / n[0] / n[1]) as f64));
            if self.iblank {
                (0..count).for_each(|i| self.int(&mut data, if i == 0 { 0 } else { (i % 2) as i32 * 2 - 1 }));
            }
            self.record(&mut out, data);
        }
        out
    }

    /// Density 2, momentum (4, 0, i), energy 100.
    pub fn solution(&self) -> Vec<u8> {
        let mut out = self.header();
        for n in &self.dims {
            let (mut reference, mut data, count) = (Vec::new(), Vec::new(), n.iter().product::<usize>());
            self.reals(&mut reference, [0.8, 0.0, 1e6, 0.0]);
            self.record(&mut out, reference);
            for constant in [2.0, 4.0, 0.0] {
                self.reals(&mut data, (0..count).map(|_| constant));
            }
            self.reals(&mut data, (0..count).map(|i| i as f64));
            self.reals(&mut data, (0..count).map(|_| 100.0));
            self.record(&mut out, data);
        }
        out
    }
}

#[test]
fn plot3d_variants_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, solution) = (folder.path().join("a_xyz.bin"), folder.path().join("a_q.bin"));
    for (bits, padding) in (0..32_u32).flat_map(|bits| [(bits, 0), (bits, 40)]) {
        let bit = |i: u32| bits >> i & 1 == 1;
        let file = Plot3d {
            little: bit(0),
            records: bit(1),
            counted: bit(2),
            double: bit(3),
            iblank: bit(4),
            dims: vec![[3, 4, 5]],
        };
        let padded = |mut bytes: Vec<u8>| {
            bytes.resize(bytes.len() + padding, 0);
            bytes
        };
        std::fs::write(&grid, padded(file.grid())).unwrap();
        std::fs::write(&solution, padded(file.solution())).unwrap();
        let mesh = plot3d::read(&grid, &ReadOptions::default()).unwrap_or_else(|e| panic!("{bits:05b} {padding}: {e}"));
        let Topology::Structured { points, blank } = &mesh.topology else { panic!("not structured") };
        assert_eq!(*points, [3, 4, 5], "{bits:05b}");
        let blanked: Vec<_> = blank.iter().enumerate().filter_map(|(i, b)| b.then_some(i)).collect();
        assert_eq!(blanked, if file.iblank { vec![0] } else { vec![] }, "{bits:05b}");
        assert_eq!(mesh.points[59], DVec3::new(2.0, 3.0, 4.0), "{bits:05b}");
        let at_2 = |name: &str| mesh.arrays.iter().find(|a| a.name == name).unwrap().values[2];
        let pressure = 0.4 * (100.0 - 0.5 * 20.0 / 2.0);
        let got =
            [at_2("Density"), at_2("StagnationEnergy"), at_2("MomentumMagnitude"), at_2("Pressure"), at_2("Mach")];
        let want = [2.0, 100.0, 20_f64.sqrt(), pressure, 20_f64.sqrt() / 2.0 / (1.4 * pressure / 2.0_f64).sqrt()];
        assert!(difference(&got, &want) < 1e-14, "{bits:05b}: {got:?} {want:?}");
        assert_eq!(mesh.arrays[1].values[6..9], [4.0, 0.0, 2.0], "{bits:05b}: the momentum of point 2");
        assert!(mesh.notes.iter().any(|n| n.text.contains("a_q.bin")), "the guess must be told");
        let error = plot3d::read(&solution, &ReadOptions::default()).unwrap_err().to_string();
        assert!(error.contains("solution (q) file of 3x4x5"), "{bits:05b}: {error}");
    }
}

#[test]
fn plot3d_blocks_lie_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, solution) = (folder.path().join("grid.x"), folder.path().join("flow.q"));
    let dims = vec![[3, 4, 5], [2, 2, 2]];
    let file = Plot3d { little: true, records: true, counted: true, double: false, iblank: true, dims };
    std::fs::write(&grid, file.grid()).unwrap();
    std::fs::write(&solution, file.solution()).unwrap();
    let options = ReadOptions {
        solution: Some(solution.clone()),
        arrays: ArrayChoice::One(Some("Momentum:z".into())),
        ..Default::default()
    };
    let mesh = plot3d::read(&grid, &options).unwrap();
    // Each block loses the cell at its blanked first point; the second block has no other.
    let Topology::Cells { kinds, nodes } = &mesh.topology else { panic!("not explicit") };
    assert_eq!((kinds.len(), nodes.len(), mesh.points.len()), (2 * 3 * 4 - 1, 8 * 23, 68));
    assert_eq!(nodes[..8], [1, 2, 5, 4, 13, 14, 17, 16]);
    assert_eq!((mesh.arrays.len(), mesh.available.len()), (1, 6));
    assert_eq!(mesh.arrays[0].values[3 * 67..], [4.0, 0.0, 7.0]);
    assert_eq!(plot3d::read(&grid, &ReadOptions::default()).unwrap().arrays, []);
    let other = Plot3d { dims: vec![[3, 4, 5], [2, 2, 3]], ..file };
    std::fs::write(&solution, other.solution()).unwrap();
    let error = plot3d::read(&grid, &options).unwrap_err().to_string();
    assert!(error.contains("has 3x4x5, 2x2x3 points and the grid 3x4x5, 2x2x2"), "{error}");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn real_plot3d_data_agree_with_vtk() {
    // VTK 9.7's vtkMultiBlockPLOT3DReader: cells, bounds' diagonal corner, and range and sum of some fields, whose
    // pressures it computes in f32.
    let cases = [
        (
            "bluntfin",
            37_479,
            [14.362203598022461, 8.327558517456055, 5.7242512702941895],
            484,
            [
                ("Density", 0.19259999692440033, 4.977499961853027, 47453.36995767057),
                ("Momentum", -3.7339000701904297, 5.790299892425537, 69110.2463664086),
                ("StagnationEnergy", 0.7689569592475891, 25.160999298095703, 254992.00826573372),
                ("Pressure", 0.2595478892326355, 10.012680053710938, 73114.20448446274),
            ],
        ),
        (
            "post",
            102_675,
            [15.0, 14.996709823608398, 4.820525169372559],
            0,
            [
                ("Density", 1.0, 1.0, 109744.0),
                ("Momentum", -0.6756314635276794, 1.3617545366287231, 37850.66822583932),
                ("StagnationEnergy", -0.541506290435791, 4.395837306976318, 239336.899256578),
                ("Pressure", -0.21661846339702606, 1.7583348751068115, 88171.11600872104),
            ],
        ),
    ];
    for (name, cells, corner, padding, fields) in cases {
        let grid = data().join(format!("plot3d/{name}xyz.bin"));
        let mesh = plot3d::read(&grid, &ReadOptions::default()).unwrap();
        assert_eq!(mesh.topology.cell_count(), cells);
        assert!(matches!(&mesh.topology, Topology::Structured { blank, .. } if blank.is_empty()));
        assert_eq!(Bounds::of(mesh.points.iter().copied()).max.to_array(), corner);
        assert_eq!(mesh.notes.iter().map(|n| n.count).max(), Some(padding), "{:?}", mesh.notes);
        for (field, min, max, sum) in fields {
            let values = &mesh.arrays.iter().find(|a| a.name == field).unwrap().values;
            let range = Interval::of(values.iter().copied());
            let got = [range.min, range.max, values.iter().sum()];
            // 6e-8 was seen, of f32 pressures.
            assert!(difference(&got, &[min, max, sum]) < 5e-7, "{name} {field}: {got:?}");
        }
    }
}
