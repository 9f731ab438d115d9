// The faces of a hull's points, for engines that take no points alone; three.js finds them, as it does for three-to-cannon.
import {Vector3} from 'three';
import {ConvexHull} from 'three/addons/math/ConvexHull.js';

/**
 * The triangles of the surface, counterclockwise as seen from outside, as indices of the vertices that they have; null where
 * the points span no volume, within the tolerance of the hull's maker.
 */
export const facesOf = (points) => {
  if (points.length < 4) return null;
  const {faces, tolerance} = new ConvexHull().setFromPoints(points.map((v) => new Vector3(...v)));
  const vertices = [];
  const known = new Map();
  const indexOf = ({point}) => {
    const key = point.toArray().join();
    if (!known.has(key)) known.set(key, vertices.push(point.toArray()) - 1);
    return known.get(key);
  };
  const triangles = faces.map(({edge}) => [edge, edge.next, edge.prev].map(({vertex}) => indexOf(vertex)));
  const inside = faces.length > 0 && faces.some((face) => vertices.some((v) => face.distanceToPoint(new Vector3(...v)) < -tolerance));
  return inside ? {vertices, triangles} : null;
};
