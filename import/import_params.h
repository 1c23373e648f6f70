// SPDX-License-Identifier: MIT
// What worlds of Webots leave unsaid: defaults of its nodes and PROTOs, and the limits of what is carried.
#pragma once
#include "sim_core/world/robot_model.h"

namespace wbt {

// an e-puck built of plain nodes is recognised by its wheels
inline constexpr double kWheelRadiusMinM = 0.019;  // [epuck-robot A1: 0.0200 to 0.02125]
inline constexpr double kWheelRadiusMaxM = 0.022;  // [epuck-robot A1: 0.0200 to 0.02125]
inline constexpr double kAxleMinM = 0.050;         // [epuck-robot A1: 0.051 to 0.0569]
inline constexpr double kAxleMaxM = 0.058;         // [epuck-robot A1: 0.051 to 0.0569]

// the product's DifferentialWheels node
inline constexpr double kProtoSpeedUnitRadS = 0.00628;  // [Webots: EPuck.proto]
inline constexpr double kNodeSpeedUnitRadS = 1.0;       // [Webots: DifferentialWheels.speedUnit since 6.0]
inline constexpr double kOldNodeSpeedUnitRadS = 0.1;    // [Webots: DifferentialWheels.speedUnit before 6.0]
inline constexpr double kNodeSlipNoise = 0.1;           // [Webots: DifferentialWheels.slipNoise]

inline constexpr double kBasicTimeStepMs = 32;   // [Webots: WorldInfo.basicTimeStep]
inline constexpr double kDensityKgM3 = 1000;     // [Webots: Physics.density]
inline constexpr double kContactBounce = 0.5;    // [Webots: ContactProperties.bounce]
inline constexpr double kContactFriction = 1;    // [Webots: ContactProperties.coulombFriction]
inline constexpr double kMaterialDiffuse = 0.8;  // [Webots: Material.diffuseColor]
inline constexpr double kSunDistanceM = 900;  // [assumed: a lamp so far away lights like a DirectionalLight]

// RectangleArena
inline constexpr double kArenaSizeM = 1.0;            // [Webots: RectangleArena.floorSize]
inline constexpr double kArenaWallHeightM = 0.1;      // [Webots: RectangleArena.wallHeight]
inline constexpr double kArenaWallThicknessM = 0.01;  // [Webots: RectangleArena.wallThickness]

// pictures that only Webots has
inline constexpr sim::Colour kWood{0.60, 0.45, 0.30};     // [assumed: pine and parquet]
inline constexpr sim::Colour kParquet{0.78, 0.68, 0.54};  // [assumed: light, so that boxes of wood stand out]
inline constexpr sim::Colour kCardboard{0.65, 0.52, 0.38};  // [assumed: brown cardboard]
inline constexpr sim::Colour kMetal{0.80, 0.80, 0.80};      // [assumed: brushed aluminium]
inline constexpr sim::Colour kStone{0.55, 0.55, 0.55};      // [assumed: concrete, stone, asphalt]
inline constexpr sim::Colour kGreen{0.30, 0.50, 0.25};      // [assumed: grass]
inline constexpr sim::Colour kRed{0.60, 0.30, 0.25};        // [assumed: bricks]

// what counts as what
inline constexpr double kUprightZ = 0.9995;       // [assumed: 1.8 degrees off the vertical is upright]
inline constexpr double kFlatM = 0.0015;          // [assumed: lower things are marks on the floor]
inline constexpr double kGapM = 0.002;            // [assumed: fixed bodies so near the floor stand on it]
inline constexpr double kTouchM = 0.0005;         // [assumed: movable ones likewise]
inline constexpr double kFloorSideM = 0.25;       // [assumed: a floor is at least so wide]
inline constexpr double kFloorBelowM = 0.06;      // [assumed: a robot begins at most so high above its floor]
inline constexpr double kFloorAboveM = 0.03;      // [assumed: or with its origin so deep in it]
inline constexpr double kSheetM = 0.002;          // [assumed: thickness given to walls without one]
inline constexpr double kSteepestRampRad = 0.69;  // [world-format: ramps have at most 40 degrees]
inline constexpr double kFullMesh = 0.6;          // [assumed: a mesh that fills less of its hull is hollow]

// bounds of our world files
inline constexpr double kLeastM = 0.0005;      // [world-format]
inline constexpr double kFarthestM = 1000;     // [world-format]
inline constexpr double kLightestKg = 0.0001;  // [world-format]
inline constexpr double kHeaviestKg = 1000;    // [world-format]
inline constexpr double kGravityMin = 0.01;    // [world-format]
inline constexpr double kGravityMax = 100;     // [world-format]
inline constexpr double kLightMax = 10000;     // [world-format]
inline constexpr double kFarthestRowM = 10;    // [world-format: of a lookup table]
inline constexpr double kSpeedUnitMin = 1e-6;  // [world-format]
inline constexpr double kSpeedUnitMax = 1000;  // [world-format]
inline constexpr double kFadesLeast = 1e-6;  // [assumed: smaller factors of a lamp's fading are written as 0]
inline constexpr std::size_t kLongestDevice = 31;  // [world-format: characters of a device's name]

// bounds of the importer itself
inline constexpr int kMostVisits = 200'000;          // [assumed: nodes looked at, USE counted each time]
inline constexpr int kMostBodies = 5000;             // [assumed: larger worlds are of no use here]
inline constexpr int kMostPieces = 20'000;           // [assumed: of all bodies]
inline constexpr int kMostRobots = 1000;             // [assumed: as the one above]
inline constexpr std::size_t kMostRecognition = 20;  // [assumed: colours of one thing]
inline constexpr int kMostMovable = 500;             // [assumed: as the one above]
inline constexpr int kMostContacts = 200;            // [assumed: as the one above]
inline constexpr int kMostNeighbours = 300;          // [assumed: a robot among more has no room]
inline constexpr std::size_t kMostRows = 100;        // [assumed: of a lookup table; Webots' have 10]
inline constexpr int kMostLines = 1000;              // [assumed: nobody reads more]
inline constexpr int kMostCommentLines = 60;         // [assumed: in the world file; all of them go to stderr]
inline constexpr int kMostFaces = 400;               // [assumed: of one mesh; more make its hull]
inline constexpr int kMostPoints = 20'000;           // [assumed: of one mesh]
inline constexpr int kMostRepairs = 40;              // [assumed: things that begin inside each other]

}  // namespace wbt
