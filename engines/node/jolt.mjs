// Jolt Physics: TransformedShape.CollideShape with the alarm distance as its largest separation; CastRay for rays.
import {centered, hasRadius, hullPairs, noRadius, rotation, serve, versionOf} from './loop.mjs';
import load from 'jolt-physics';

const jolt = await load();

// Nothing collides before a JoltInterface has been made.
const layer = 0;
const pairs = new jolt.ObjectLayerPairFilterTable(1);
pairs.EnableCollision(layer, layer);
const broad = new jolt.BroadPhaseLayerInterfaceTable(1, 1);
broad.MapObjectToBroadPhaseLayer(layer, new jolt.BroadPhaseLayer(0));
const world = new jolt.JoltSettings();
world.mObjectLayerPairFilter = pairs;
world.mBroadPhaseLayerInterface = broad;
world.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, pairs, 1);
new jolt.JoltInterface(world);

const [unit, origin] = [new jolt.Vec3(1, 1, 1), new jolt.RVec3(0, 0, 0)];
const [settings, everything] = [new jolt.CollideShapeSettings(), new jolt.ShapeFilter()];
// Triangles have two sides.
settings.mBackFaceMode = jolt.EBackFaceMode_CollideWithBackFaces;
const flat = {unsupported: 'a triangle without an inside, or a hull that it does not make'};
const numbers = (v) => [v.GetX(), v.GetY(), v.GetZ()];

// Points are relative to the base offset, which is the origin here.
serve({
  engine: {name: 'jolt', version: versionOf('jolt-physics')}, scalar: 'binary32', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule', 'sphere_triangle', 'ray_sphere', 'sphere_plane', 'capsule_plane', 'ray_triangle', 'triangle_line',
    'obb_obb', 'sphere_obb', 'capsule_cube', 'capsule_obb', 'capsule_triangle', 'cube_obb', 'cube_triangle', 'obb_triangle', 'triangle_triangle', 'cube_plane',
    'obb_plane', 'triangle_plane', ...hullPairs, 'triangle_hull', 'hull_plane'],
  conventions: {normal_unit: false, value: 'depth', value_less_contact: false, shapes: 'centered'},
  pair_conventions: {
    // Where a ray enters a sphere is no nearest point; it has no normal before its user asks for one.
    ray_sphere: {margin: 'none', normal: 'none', points: 'none', value: 'none'},
    ray_triangle: {normal: 'none', value: 'none'}, triangle_line: {normal: 'none', value: 'none'},
  },
}, ({a, b, alarm}) => {
  if (hasRadius(a) || hasRadius(b)) return noRadius;
  const [made, shapes] = [[], []];
  const make = (thing) => (made.push(thing), thing);
  const created = (shapeSettings) => {
    const result = make(shapeSettings).Create();
    return result.IsValid() ? result.Get() : null;
  };
  const kinds = {
    sphere: ({radius}) => new jolt.SphereShape(radius),
    // Without a convex radius, as the hull below: its edges are as sharp as the question's.
    box: ({half}) => new jolt.BoxShape(make(new jolt.Vec3(...half)), 0),
    capsule: ({halfLength, radius}) => new jolt.CapsuleShape(halfLength, radius),
    // Only a mesh has triangles here. It takes none without an inside.
    triangle: ({vertices}) => {
      const list = make(new jolt.TriangleList());
      list.push_back(make(new jolt.Triangle(...vertices.map((v) => make(new jolt.Vec3(...v))))));
      return created(new jolt.MeshShapeSettings(list));
    },
    // A mesh collides with no mesh and no plane; the hull of the corners does. A convex radius would make a hull no larger: it
    // rounds what it has.
    hull: ({vertices}) => {
      const hull = new jolt.ConvexHullShapeSettings();
      vertices.forEach((v) => hull.mPoints.push_back(make(new jolt.Vec3(...v))));
      hull.mMaxConvexRadius = 0;
      return created(hull);
    },
    // Its planes end somewhere: farther away than any question reaches.
    plane: ({normal}) => new jolt.PlaneShape(make(new jolt.Plane(make(new jolt.Vec3(...normal)), 0)), null, 2 ** 120),
  };
  const shaped = (like) => {
    const shape = kinds[like.kind](like);
    if (!shape) return null;
    shape.AddRef();
    shapes.push(shape);
    return shape;
  };
  const at = ({center}) => make(new jolt.RVec3(...center));
  const upright = (shape) => make(new jolt.Quat(...rotation(shape, 1)));
  const done = (answer) => {
    made.forEach((thing) => jolt.destroy(thing));
    shapes.forEach((shape) => shape.Release());
    return answer;
  };
  let [from, to] = [centered(a), centered(b)];
  if (to.kind === 'line') [from, to] = [to, from];
  if (from.kind === 'triangle') from.kind = 'hull';
  const second = make(new jolt.TransformedShape());
  const shape2 = shaped(to);
  if (!shape2) return done(flat);
  second.mShape = shape2;
  second.SetWorldTransform(at(to), upright(to), unit);
  if (from.kind === 'ray' || from.kind === 'line') {
    const way = from.end.map((x, i) => x - from.start[i]);
    const ray = make(new jolt.RRayCast(make(new jolt.RVec3(...from.start)), make(new jolt.Vec3(...way))));
    const result = make(new jolt.RayCastResult());
    second.CastRay(ray, result);
    if (result.mFraction > 1) return done({overlap: false, contact: null}); // beyond 1 where it hits nothing
    const point = numbers(ray.GetPointOnRay(result.mFraction));
    return done({overlap: true, contact: to.kind === 'sphere' ? {} : {point1: point, point2: point}});
  }
  settings.mMaxSeparationDistance = alarm;
  const collector = make(new jolt.CollideShapeClosestHitCollisionCollector());
  // The shape that is handed over is shape 1 of the result.
  const shape1 = shaped(from);
  if (!shape1) return done(flat);
  // A hull lies about its centre of mass.
  const place = jolt.RMat44.prototype.sRotationTranslation(upright(from), at(from)).PreTranslated(shape1.GetCenterOfMass());
  second.CollideShape(shape1, unit, place, settings, origin, collector, everything);
  const found = collector.HadHit() ? collector.mHit : null;
  const contact = found && {
    normal: numbers(found.mPenetrationAxis), point1: numbers(found.mContactPointOn1),
    point2: numbers(found.mContactPointOn2), value: found.mPenetrationDepth,
  };
  return done({overlap: found !== null, contact});
});
