// Jolt Physics: TransformedShape.CollideShape with the alarm distance as its largest separation.
import {centered, serve, versionOf} from './loop.mjs';
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

const [unit, origin, upright] = [new jolt.Vec3(1, 1, 1), new jolt.RVec3(0, 0, 0), new jolt.Quat(0, 0, 0, 1)];
const [settings, everything] = [new jolt.CollideShapeSettings(), new jolt.ShapeFilter()];
const numbers = (v) => [v.GetX(), v.GetY(), v.GetZ()];

// Points are relative to the base offset, which is the origin here.
serve({
  engine: {name: 'jolt', version: versionOf('jolt-physics')}, scalar: 'binary32', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {normal_unit: false, value: 'depth', value_less_contact: false, shapes: 'centered'},
}, ({pair, a, b, alarm}) => {
  const [made, shapes] = [[], []];
  const make = (thing) => (made.push(thing), thing);
  const kept = (shape) => {
    shape.AddRef();
    shapes.push(shape);
    return shape;
  };
  const sphere = ({radius}) => kept(new jolt.SphereShape(radius));
  // Without a convex radius: its edges are as sharp as the question's.
  const box = ({half}) => kept(new jolt.BoxShape(make(new jolt.Vec3(...half)), 0));
  const at = ({center}) => make(new jolt.RVec3(...center));
  const second = make(new jolt.TransformedShape());
  const centeredB = pair === 'sphere_cube' ? centered(b) : b;
  second.mShape = pair === 'sphere_cube' ? box(centeredB) : sphere(b);
  second.SetWorldTransform(at(centeredB), upright, unit);
  settings.mMaxSeparationDistance = alarm;
  const collector = make(new jolt.CollideShapeClosestHitCollisionCollector());
  // The shape that is handed over is shape 1 of the result.
  const place = jolt.RMat44.prototype.sTranslation(at(a));
  second.CollideShape(sphere(a), unit, place, settings, origin, collector, everything);
  const found = collector.HadHit() ? collector.mHit : null;
  const contact = found && {
    normal: numbers(found.mPenetrationAxis), point1: numbers(found.mContactPointOn1),
    point2: numbers(found.mContactPointOn2), value: found.mPenetrationDepth,
  };
  made.forEach((thing) => jolt.destroy(thing));
  shapes.forEach((shape) => shape.Release());
  return {overlap: found !== null, contact};
});
