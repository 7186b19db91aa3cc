//! What is edited, and undone: the transfer functions, and how the medium looks.

use glam::DVec3;

use crate::scene::{
    Camera, CameraChoice, Curve, CurveNode, Draft, Opening, Optics, Projection, Scene, TransferChoice,
    TransferFunction, Units, Viewpoint, Widget, WidgetShape, suggest,
};
use crate::space::{Bounds, Interval};
use crate::tet::{JointHistogram, TetMesh};

/// Which of the two functions is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Widgets over the scalar and its gradient magnitude.
    #[default]
    Bivariate,
    /// A curve over the scalar.
    Univariate,
}

/// A widget in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Data units.
    pub widget: Widget,
    /// Left out of the picture.
    pub is_hidden: bool,
}

/// Both functions and what applies to the whole picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Which is drawn.
    pub kind: Kind,
    /// Back to front in the list; their order does not change the picture.
    pub items: Vec<Item>,
    /// The only one that is drawn, if there is one.
    pub solo: Option<usize>,
    /// Data units.
    pub curve: Curve,
    /// All extinctions are multiplied by it.
    pub brightness: f64,
    /// Emission, lighting, silhouettes.
    pub optics: Optics,
    /// Linear, straight.
    pub background: [f64; 4],
    /// What is outside of it is cut off, data space.
    pub clip: Option<Bounds>,
}

/// Colours of new widgets, linear: those of Okabe and Ito 2008, told apart with any colour vision.
const COLORS: [[f64; 3]; 6] = [
    [0.791, 0.347, 0.000],
    [0.093, 0.456, 0.815],
    [0.000, 0.342, 0.171],
    [0.871, 0.776, 0.054],
    [0.665, 0.112, 0.000],
    [0.604, 0.191, 0.386],
];

impl Look {
    /// What shows something of a mesh: suggested widgets, and a curve of the same optical depth.
    pub fn of(mesh: &TetMesh, histogram: &JointHistogram) -> Self {
        let items = match suggest(mesh, histogram) {
            TransferFunction::Widgets(widgets) => {
                widgets.into_iter().map(|widget| Item { widget, is_hidden: false }).collect()
            }
            TransferFunction::Curve(_) => Vec::new(),
        };
        let diagonal = mesh.bounds_in_data().diagonal();
        Self {
            kind: Kind::Bivariate,
            items,
            solo: None,
            curve: ramp(mesh.scalar_range(), 3.0 / diagonal),
            brightness: 1.0,
            optics: Optics::PLAIN,
            background: [0.0, 0.0, 0.0, 1.0],
            clip: None,
        }
    }

    fn is_drawn(&self, index: usize) -> bool {
        self.solo.map_or(!self.items[index].is_hidden, |solo| solo == index)
    }

    fn brighter(&self, widget: &Widget) -> Widget {
        Widget { extinction: widget.extinction * self.brightness, ..widget.clone() }
    }

    /// What is drawn of one kind, data units.
    pub fn transfer(&self, kind: Kind) -> TransferFunction {
        match kind {
            Kind::Bivariate => {
                let drawn = (0..self.items.len()).filter(|&i| self.is_drawn(i));
                let widgets: Vec<Widget> = drawn.map(|i| self.brighter(&self.items[i].widget)).collect();
                if widgets.is_empty() { TransferFunction::nothing() } else { TransferFunction::Widgets(widgets) }
            }
            Kind::Univariate => {
                let brighter = |n: &CurveNode| CurveNode { extinction: n.extinction * self.brightness, ..*n };
                TransferFunction::Curve(Curve { nodes: self.curve.nodes.iter().map(brighter).collect() })
            }
        }
    }

    /// What a scene holds beside what is drawn: hidden widgets, and the other kind of function where it is not that of
    /// `first`.
    fn draft(&self, first: &Self) -> Option<Draft> {
        let has_curve = self.kind == Kind::Univariate || self.curve != first.curve;
        let has_widgets = self.kind == Kind::Bivariate || self.items != first.items;
        let mut draft = Draft::default();
        if has_widgets {
            let all = self.items.iter().enumerate();
            draft.widgets = all.map(|(index, item)| (self.brighter(&item.widget), !self.is_drawn(index))).collect();
        }
        if has_curve && let TransferFunction::Curve(curve) = self.transfer(Kind::Univariate) {
            draft.curve = Some(curve);
        }
        if self.kind == Kind::Bivariate && self.items.is_empty() && draft.curve.is_some() {
            // No widgets are drawn beside the curve: a file says so by one that shows nothing.
            draft.widgets.push((Widget::new(WidgetShape::Uniform, [0.0; 3], 0.0), false));
        }
        let is_more = draft.curve.is_some() && !draft.widgets.is_empty();
        (is_more || draft.widgets.iter().any(|(_, is_hidden)| *is_hidden)).then_some(draft)
    }

    /// A scene of what is drawn, and of what is not, where that was made: `first` is what the window began with.
    pub fn scene(&self, camera: &Camera, size: [u32; 2], field: &str, first: &Self) -> Scene {
        let opening = match camera.projection {
            Projection::Perspective { fov_y } => Opening::Perspective { fov_y },
            Projection::Orthographic { height } => Opening::Orthographic { height: Some(height) },
        };
        let viewpoint = Viewpoint::At { eye: camera.eye, target: Some(camera.target), up: Some(camera.up) };
        Scene {
            camera: CameraChoice { viewpoint, opening, near: camera.near },
            size,
            background: self.background,
            field: Some(field.to_owned()),
            transfer: Some(TransferChoice {
                units: Units::Data,
                function: self.transfer(self.kind),
                draft: self.draft(first),
            }),
            optics: self.optics,
            clip: self.clip,
        }
    }

    /// Takes what a scene says, for a mesh of these ranges; what it does not name stays.
    pub fn take(&mut self, scene: &Scene, scalar: Interval, gradient: Interval) {
        (self.optics, self.background, self.clip) = (scene.optics, scene.background, scene.clip);
        (self.brightness, self.solo) = (1.0, None);
        match scene.transfer.as_ref().map(|choice| choice.resolve(scalar, gradient)) {
            Some(TransferFunction::Widgets(widgets)) => {
                self.items = widgets.into_iter().map(|widget| Item { widget, is_hidden: false }).collect();
                self.kind = Kind::Bivariate;
            }
            Some(TransferFunction::Curve(curve)) => (self.curve, self.kind) = (curve, Kind::Univariate),
            None => {}
        }
        if let Some(draft) = scene.transfer.as_ref().and_then(|choice| choice.resolve_draft(scalar, gradient)) {
            self.items = draft.widgets.into_iter().map(|(widget, is_hidden)| Item { widget, is_hidden }).collect();
            self.curve = draft.curve.unwrap_or_else(|| self.curve.clone());
        }
    }

    /// Adds a widget of this shape that is as dense as the others are, in a colour that is not among them if there is one.
    pub fn add(&mut self, shape: WidgetShape, diagonal: f64) -> usize {
        let taken = |color: &[f64; 3]| self.items.iter().filter(|item| item.widget.color == *color).count();
        let color = COLORS.into_iter().min_by_key(taken).unwrap_or([1.0; 3]);
        let densest = self.items.iter().map(|item| item.widget.extinction).fold(0.0, f64::max);
        let extinction = if densest > 0.0 { densest } else { 10.0 / diagonal };
        self.items.push(Item { widget: Widget::new(shape, color, extinction), is_hidden: false });
        self.items.len() - 1
    }
}

/// From transparent to what has this extinction, from blue to yellow.
fn ramp(range: Interval, extinction: f64) -> Curve {
    let node = |share: f64, color: [f64; 3]| CurveNode {
        scalar: range.min + share * range.length(),
        color,
        extinction: share * share * extinction,
    };
    let nodes = [(0.0, [0.02, 0.05, 0.4]), (0.5, [0.1, 0.5, 0.4]), (1.0, [0.95, 0.8, 0.1])];
    // Of a constant field all is one node.
    let count = if range.length() > 0.0 { 3 } else { 1 };
    Curve { nodes: nodes[3 - count..].iter().map(|&(share, color)| node(share, color)).collect() }
}

/// Turns the camera around what it looks at, as if a ball of the picture's size were rolled: radians to the right and up.
pub fn orbit(camera: &mut Camera, right: f64, up: f64) {
    let basis = camera.basis();
    let turn = glam::DQuat::from_axis_angle(basis.up, -right) * glam::DQuat::from_axis_angle(basis.right, -up);
    camera.eye = camera.target + turn * (camera.eye - camera.target);
    camera.up = turn * basis.up;
}

/// Turns the picture, radians counter-clockwise.
pub fn roll(camera: &mut Camera, angle: f64) {
    let basis = camera.basis();
    camera.up = glam::DQuat::from_axis_angle(basis.forward, angle) * basis.up;
}

/// Moves the picture, shares of its height to the right and down.
pub fn pan(camera: &mut Camera, right: f64, down: f64) {
    let basis = camera.basis();
    let height = match camera.projection {
        Projection::Perspective { fov_y } => 2.0 * (0.5 * fov_y).tan() * camera.target.distance(camera.eye),
        Projection::Orthographic { height } => height,
    };
    let by = height * (down * basis.up - right * basis.right);
    camera.eye += by;
    camera.target += by;
}

/// Moves towards what is looked at, or away: what is there becomes so many times larger.
pub fn zoom(camera: &mut Camera, by: f64) {
    match &mut camera.projection {
        Projection::Perspective { .. } => camera.eye = camera.target + (camera.eye - camera.target) / by,
        Projection::Orthographic { height } => *height /= by,
    }
}

/// Moves eye and target along the view's axes, data units: right, up, ahead.
pub fn fly(camera: &mut Camera, by: [f64; 3]) {
    let basis = camera.basis();
    let by: DVec3 = by[0] * basis.right + by[1] * basis.up + by[2] * basis.forward;
    camera.eye += by;
    camera.target += by;
}

/// From perspective to parallel rays and back: what is looked at keeps its size. `fov_y`: radians.
pub fn switch_projection(camera: &mut Camera, fov_y: f64) {
    let distance = camera.target.distance(camera.eye);
    match camera.projection {
        Projection::Perspective { fov_y } => {
            camera.projection = Projection::Orthographic { height: 2.0 * (0.5 * fov_y).tan() * distance };
        }
        Projection::Orthographic { height } => {
            let away = (camera.eye - camera.target).normalize_or(DVec3::Z);
            camera.eye = camera.target + away * (0.5 * height / (0.5 * fov_y).tan());
            camera.projection = Projection::Perspective { fov_y };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_drawn_is_kept_where_it_was_made() {
        let widget =
            |extinction| Item { widget: Widget::new(WidgetShape::Uniform, [1.0; 3], extinction), is_hidden: false };
        let range = Interval { min: 0.0, max: 2.0 };
        let first = Look {
            kind: Kind::Bivariate,
            items: vec![widget(1.0), widget(2.0)],
            solo: None,
            curve: ramp(range, 3.0),
            brightness: 1.0,
            optics: Optics::PLAIN,
            background: [0.0; 4],
            clip: None,
        };
        let saved = |look: &Look| look.scene(&camera(), [4, 4], "f", &first);
        assert_eq!(saved(&first).transfer.expect("a function").draft, None, "nothing was made that is not drawn");
        let mut look = first.clone();
        look.items[0].is_hidden = true;
        look.curve.nodes[1].extinction = 9.0;
        look.brightness = 2.0;
        look.clip = Some(Bounds { min: DVec3::ZERO, max: DVec3::ONE });
        for kind in [Kind::Bivariate, Kind::Univariate] {
            look.kind = kind;
            let scene = Scene::parse(&saved(&look).to_toml(), &[]).expect("a scene");
            let mut taken = first.clone();
            taken.take(&scene, range, range);
            // What was brighter is denser.
            assert_eq!((taken.kind, taken.clip, taken.brightness), (kind, look.clip, 1.0));
            assert_eq!(taken.transfer(kind), look.transfer(kind));
            assert_eq!(taken.curve.nodes[1].extinction, 18.0);
            let kept: Vec<_> = taken.items.iter().map(|item| (item.widget.extinction, item.is_hidden)).collect();
            assert_eq!(kept, [(2.0, true), (4.0, false)], "{kind:?}");
        }
    }

    fn camera() -> Camera {
        let (eye, target, up) = (DVec3::new(10.0, 2.0, 1.0), DVec3::new(1.0, 1.0, 1.0), DVec3::Z);
        Camera { eye, target, up, projection: Projection::Perspective { fov_y: 0.5 }, near: None }
    }

    #[test]
    fn cameras_keep_what_they_look_at() {
        let before = camera();
        let mut turned = before;
        for _ in 0..100 {
            orbit(&mut turned, 0.05, 0.04);
        }
        roll(&mut turned, 1.0);
        assert_eq!(turned.target, before.target);
        assert!((turned.eye.distance(turned.target) - before.eye.distance(before.target)).abs() < 1e-9);
        assert!(turned.basis().up.is_finite());
        let mut there = before;
        switch_projection(&mut there, 0.5);
        switch_projection(&mut there, 0.5);
        assert!(there.eye.distance(before.eye) < 1e-9 && there.projection == before.projection);
        let mut near = before;
        zoom(&mut near, 2.0);
        assert!((near.eye.distance(near.target) * 2.0 - before.eye.distance(before.target)).abs() < 1e-9);
    }

    #[test]
    fn a_pan_moves_what_is_looked_at_by_its_share_of_the_picture() {
        let mut panned = camera();
        let target = panned.target;
        pan(&mut panned, 0.25, -0.125);
        let basis = panned.basis();
        let away = target - panned.eye;
        let height = 2.0 * 0.25_f64.tan() * away.dot(basis.forward);
        let [x, y] = [away.dot(basis.right) / height, away.dot(basis.up) / height];
        assert!((x - 0.25).abs() < 1e-12 && (y - 0.125).abs() < 1e-12, "{x} {y}");
    }
}
