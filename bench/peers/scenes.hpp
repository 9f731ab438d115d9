// Pairs as scenes have them: on floors, beside walls, upright, along axes and diagonals. Random numbers never are.
#pragma once

#include <string>
#include <vector>

#include "contact/pairs.hpp"
#include "uniform.hpp"

namespace contact::bench {

/// Pairs of one kind, the next of which `make` makes.
template <class A, class B>
struct Scene {
  std::string name;
  Two<A, B> (*make)(Uniform&);
};

/// A point of a cube about the origin.
inline Vector3 within(Uniform& u, double half) {
  const double x = half * (2 * u.part() - 1);
  const double y = half * (2 * u.part() - 1);
  return {x, y, half * (2 * u.part() - 1)};
}
inline Capsule upright(Uniform& u) {
  const Vector3 start = within(u, 2.5);
  return {start, start + Vector3(0, 0, 4), 1};
}

/// About half of the pairs are hits.
inline const std::vector<Scene<Ball, Ball>> kScenesOfBalls{
    {"spheres, stacked", [](Uniform& u) {
       const Vector3 at = within(u, 3);
       return Balls{{at, 1.5}, {at + Vector3(0, 0, 6 * u.part()), 1.5}};
     }}};
inline const std::vector<Scene<Ball, Plane>> kScenesOfPlanes{
    {"sphere, floor", [](Uniform& u) {
       return BallAndPlane{{within(u, 3), 0.5}, {{0, 0, 1}, 0}};
     }}};
inline const std::vector<Scene<Capsule, Plane>> kScenesOfCapsulesAndPlanes{
    {"capsule, floor",
     [](Uniform& u) {
       return CapsuleAndPlane{{within(u, 3), within(u, 3), 0.25}, {{0, 0, 1}, -1}};
     }},
    {"capsule upright, floor",
     [](Uniform& u) {
       return CapsuleAndPlane{upright(u), {{0, 0, 1}, -1}};
     }},
    {"capsule lying, floor", [](Uniform& u) {
       const Vector3 at = within(u, 3);
       return CapsuleAndPlane{{at, at + Vector3(2 * u.part(), 3 * u.part(), 0), 0.5}, {{0, 0, 1}, 0}};
     }}};
inline const std::vector<Scene<Ball, Capsule>> kScenesOfCapsules{
    {"sphere, capsule upright", [](Uniform& u) {
       return BallAndCapsule{{within(u, 3), 1.5}, upright(u)};
     }}};
inline const std::vector<Scene<Capsule, Capsule>> kScenesOfTwoCapsules{
    {"capsules, upright",
     [](Uniform& u) {
       const Capsule first = upright(u);
       return Capsules{first, upright(u)};
     }},
    {"capsules, upright and lying", [](Uniform& u) {
       const Capsule first = upright(u);
       const Vector3 at = within(u, 3);
       return Capsules{first, {at, at + Vector3(4, 0, 0), 1}};
     }}};
inline const std::vector<Scene<Ball, Triangle>> kScenesOfTriangles{
    {"sphere, triangle of a floor",
     [](Uniform& u) {
       const Triangle floor{{Vector3(-3, -3, 0), Vector3(3, -3, 0), Vector3(-1, 4, 0)}};
       return BallAndTriangle{{within(u, 2), 1}, floor};
     }},
    {"sphere, triangle of a grid", [](Uniform& u) {
       const Triangle half{{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}};
       const double x = u.part();
       const double y = u.part();
       return BallAndTriangle{{{x, y, u.part()}, 0.5}, half};
     }}};
inline const std::vector<Scene<Ray, Ball>> kScenesOfRays{
    {"ray down, sphere", [](Uniform& u) {
       Vector3 from = within(u, 3);
       from[2] = 5;
       return RayAndBall{{from, {0, 0, -1}, 10}, {within(u, 3), 3}};
     }}};

}  // namespace contact::bench
