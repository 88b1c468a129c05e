//! The recorder of features and of the virtual flash.

use glam::Vec3A;

use crate::bsdf::Event;
use crate::columns::{COLOR, Columns};
use crate::recorder::{End, Recorder, Turn, Vertex};
use crate::table::{Seen, Taken};

/// How far a path has come with its features.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// The surface that they belong to may lie ahead.
    Ahead,
    /// It was just left: emission at the next hit is still direct light.
    Left,
    /// They are complete.
    Done,
}

/// How far the path still belongs to the flash image (moon2013flash, Sec. 3.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reuse {
    /// Only specular and glossy vertices so far.
    Following,
    /// The first diffuse vertex was just left: emission at the next hit is its direct light, then the reuse ends.
    Ending,
    /// F0 is complete.
    Done,
}

/// What a surface gives, at these values, and what background has.
#[derive(Debug, Clone, Copy)]
struct Take {
    take: fn(&Seen<'_>) -> Vec3A,
    first: usize,
    channels: usize,
    background: f32,
}

impl Take {
    #[inline(always)]
    fn put(&self, values: &mut [f32], value: Vec3A) {
        // One by one: a copy of so few is dearer than they are.
        let value = value.to_array();
        values[self.first] = value[0];
        if self.channels > 1 {
            values[self.first + 1] = value[1];
        }
        if self.channels > 2 {
            values[self.first + 2] = value[2];
        }
    }
}

/// Keeps what columns ask for.
#[derive(Debug, Clone)]
pub struct Recording {
    takes: Vec<Take>,
    /// First values of what is no feature of the surface alone, if it is recorded.
    shadow_rays: Option<usize>,
    direct: Option<usize>,
    flash: Option<usize>,
    /// Whether features are taken at the first hit that is not specular.
    follow: bool,
    /// Where a path starts: what was not asked for is done.
    start: (Stage, Reuse),
    stage: Stage,
    reuse: Reuse,
    tint: Vec3A,
    way: f32,
    /// F0 and S of the flash.
    base: Vec3A,
    eye_light: Vec3A,
    /// All values but the colour.
    values: Vec<f32>,
}

impl Recording {
    /// Of these columns; `follow`: whether features are taken at the first hit that is not specular.
    pub fn new(columns: &Columns, follow: bool) -> Self {
        let takes = columns.list.iter().filter_map(|column| match column.row.taken {
            Taken::Surface(take, background) => {
                let (first, channels) = (column.first - COLOR, column.channels);
                Some(Take { take, first, channels, background })
            }
            _ => None,
        });
        let takes: Vec<Take> = takes.collect();
        let place = |is: fn(&Taken) -> bool| columns.first_of(is).map(|first| first - COLOR);
        let shadow_rays = place(|taken| matches!(taken, Taken::ShadowRays));
        let direct = place(|taken| matches!(taken, Taken::DirectLight));
        let flash = place(|taken| matches!(taken, Taken::Flash));
        let features = !takes.is_empty() || shadow_rays.is_some() || direct.is_some();
        let start = (
            if features { Stage::Ahead } else { Stage::Done },
            if flash.is_some() { Reuse::Following } else { Reuse::Done },
        );
        Self {
            takes,
            shadow_rays,
            direct,
            flash,
            follow,
            start,
            stage: start.0,
            reuse: start.1,
            tint: Vec3A::ONE,
            way: 0.0,
            base: Vec3A::ZERO,
            eye_light: Vec3A::ZERO,
            values: vec![0.0; columns.all - COLOR],
        }
    }

    /// The surface that features belong to, as far as the path has come; `None` for background.
    #[inline(always)]
    fn describe(&mut self, surface: Option<&Vertex<'_>>) {
        let Some(vertex) = surface else {
            for take in &self.takes {
                take.put(&mut self.values, Vec3A::splat(take.background));
            }
            return;
        };
        self.way += vertex.hit.t;
        // Copies: what functions behind pointers look at lies in memory, and only here it should.
        let (hit, at, event) = (*vertex.hit, *vertex.at, *vertex.event);
        let vertex = &Vertex { hit: &hit, at: &at, event: &event, ..*vertex };
        let seen = Seen { vertex, tint: self.tint, way: self.way };
        for take in &self.takes {
            take.put(&mut self.values, (take.take)(&seen));
        }
    }

    /// Light of unit intensity at the eye, scattered by the surface and without a shadow.
    #[inline(always)]
    fn light_from_eye(&mut self, vertex: &Vertex<'_>) {
        let Vertex { scene, view, at, to_viewer, throughput, .. } = vertex;
        let Event::Lobe(lobe) = vertex.event else { return };
        let to_eye = view.eye - at.point;
        let squared = to_eye.length_squared().max(scene.least_eye_distance * scene.least_eye_distance);
        let to_eye = to_eye.normalize_or(at.normal);
        self.eye_light += *throughput * lobe.eval(at, *to_viewer, to_eye).0 * (1.0 / squared);
    }

    #[inline(always)]
    fn put(&mut self, first: usize, value: Vec3A) {
        self.values[first..first + 3].copy_from_slice(&value.to_array());
    }

    #[inline(always)]
    fn end_direct(&mut self, color: Vec3A) {
        self.stage = Stage::Done;
        if let Some(first) = self.direct {
            self.put(first, color);
        }
    }
}

impl Recorder for Recording {
    #[inline(always)]
    fn started(&mut self) {
        (self.stage, self.reuse) = self.start;
        (self.tint, self.way) = (Vec3A::ONE, 0.0);
        (self.base, self.eye_light) = (Vec3A::ZERO, Vec3A::ZERO);
        if let Some(first) = self.shadow_rays {
            (self.values[first], self.values[first + 1]) = (0.0, 0.0);
        }
    }

    #[inline(always)]
    fn looks(&self) -> bool {
        self.stage == Stage::Ahead || self.reuse == Reuse::Following
    }

    #[inline(always)]
    fn hit(&mut self, end: &End<'_>, color: Vec3A) {
        let surface = match end {
            End::Surface(vertex) | End::Medium(Some(vertex)) => Some(vertex),
            End::Medium(None) | End::Background => None,
        };
        match self.stage {
            Stage::Ahead => self.describe(surface),
            Stage::Left => self.end_direct(color),
            Stage::Done => {}
        }
        match self.reuse {
            Reuse::Following => {
                if let Some(vertex) = surface {
                    self.light_from_eye(vertex);
                }
            }
            Reuse::Ending => (self.base, self.reuse) = (color, Reuse::Done),
            Reuse::Done => {}
        }
        // The medium scatters like a diffuse surface.
        if let End::Medium(_) = end {
            self.scattered(&Turn::Lobe { diffuse: true, reached: None });
        }
    }

    #[inline(always)]
    fn scattered(&mut self, turn: &Turn) {
        match *turn {
            Turn::Specular(tint) => {
                if self.stage == Stage::Ahead {
                    if self.follow {
                        self.tint *= tint;
                    } else {
                        self.stage = Stage::Left;
                    }
                }
            }
            Turn::Lobe { diffuse, reached } => {
                if self.stage == Stage::Ahead {
                    self.stage = Stage::Left;
                    if let (Some(first), Some(reached)) = (self.shadow_rays, reached) {
                        self.values[first] = f32::from(u8::from(reached));
                        self.values[first + 1] = 1.0;
                    }
                }
                if self.reuse == Reuse::Following && diffuse {
                    self.reuse = Reuse::Ending;
                }
            }
        }
    }

    #[inline(always)]
    fn finished(&mut self, color: Vec3A) {
        if self.stage != Stage::Done {
            self.end_direct(color);
        }
        if let Some(first) = self.flash {
            if self.reuse != Reuse::Done {
                self.base = color;
            }
            self.put(first, self.base);
            self.put(first + 3, self.eye_light);
            self.put(first + 6, self.base + self.eye_light);
        }
    }

    #[inline(always)]
    fn values(&self) -> &[f32] {
        &self.values
    }
}
