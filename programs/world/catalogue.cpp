// SPDX-License-Identifier: MIT
#include "programs/world/catalogue.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>

namespace programs {

namespace {

// name, type, and what it holds: B bool, I whole, F number, 2 and V vectors, R rotation, C colour, S text,
// N node, * list
const std::string kPlaced =
    "translation V 0 0 0|rotation R 0 0 1 0|scale V 1 1 1|children N*|translationStep F 0.01|rotationStep F "
    "0.261799";
const std::string kSolid =
    kPlaced +
    "|name S solid|model S|description S|contactMaterial S default|immersionProperties N*|"
    "boundingObject N|physics N|locked B 0|radarCrossSection F 0|recognitionColors C*";
/// A device, by its usual name.
std::string named(const std::string& name) {
  const std::string usual = "name S solid";
  std::string fields = kSolid;
  return fields.replace(fields.find(usual), usual.size(), "name S " + name);
}
const std::string kRobot =
    kSolid +
    "|controller S <generic>|controllerArgs S*|customData S|supervisor B 0|synchronization B 1|"
    "battery F*|cpuConsumption F 10|selfCollision B 0|window S <generic>|remoteControl S "
    "<generic>";
const std::string kLight = "ambientIntensity F 0|color C 1 1 1|intensity F 1|on B 1|castShadows B 0|";
const std::string kBlock = kPlaced +
                           "|name S|mass F 0|size V 0.1 0.1 0.1|locked B 0|physics N|recognitionColors C*|"
                           "contactMaterial S default|appearance N|color C 1 1 1";
const std::string kArena =
    kPlaced +
    "|name S rectangle arena|floorSize 2 1 1|floorTileSize 2 0.5 0.5|floorAppearance N|"
    "wallThickness F 0.01|wallHeight F 0.1|wallTileSize 2 0.5 0.5|wallAppearance N|"
    "contactMaterial S default";

struct KindRow {
  const char* type;
  const char* base;
  std::string fields;
};

std::vector<KindRow> bodies() {
  return {
      {"Group", "Group", "children N*"},
      {"Transform", "Transform", kPlaced},
      {"Pose", "Pose", kPlaced},
      {"Solid", "Solid", kSolid},
      {"Robot", "Robot", kRobot},
      {"Supervisor", "Supervisor", kRobot},  // a kind of its own until R2018
      {"CustomRobot", "Robot", kRobot},
      {"DifferentialWheels", "Robot",
       kRobot + "|axleLength F 0.1|wheelRadius F 0.01|maxSpeed F 10|speedUnit F 0.1|slipNoise F "
                "0.1|encoderNoise F -1"},
      {"E-puck", "Robot",
       kRobot + "|version S 1|camera_fieldOfView F 0.84|camera_width I 52|camera_height I "
                "39|camera_antiAliasing B 0|"
                "camera_rotation R 1 0 0 0|emitter_channel I 1|receiver_channel I "
                "1|distance_sensor_numberOfRays I 1|"
                "kinematic B 0|max_velocity F 6.28|turretSlot N*|groundSensorsSlot N*"},
      {"Charger", "Charger", kSolid + "|battery F*|radius F 0.04|emissiveColor C 0 1 0|gradual B 1"},
  };
}

std::vector<KindRow> shapes() {
  return {
      {"Shape", "Shape", "appearance N|geometry N|castShadows B 1|isPickable B 1"},
      {"Appearance", "Appearance", "material N|texture N|textureTransform N|name S appearance"},
      {"PBRAppearance", "PBRAppearance",
       "baseColor C 1 1 1|baseColorMap N|transparency F 0|roughness F 0|roughnessMap N|metalness F "
       "1|emissiveColor C 0 "
       "0 0|emissiveIntensity F 1|textureTransform N|name S PBRAppearance|IBLStrength F 1"},
      {"Material", "Material",
       "ambientIntensity F 0.2|diffuseColor C 0.8 0.8 0.8|emissiveColor C 0 0 0|shininess F "
       "0.2|specularColor C 0 0 0|"
       "transparency F 0"},
      {"ImageTexture", "ImageTexture", "url S*|repeatS B 1|repeatT B 1|filtering I 4"},
      {"TextureTransform", "TextureTransform", "center 2 0 0|rotation F 0|scale 2 1 1|translation 2 0 0"},
      {"Box", "Box", "size V 0.1 0.1 0.1"},
      {"Sphere", "Sphere", "radius F 0.1|subdivision I 1|ico B 1"},
      {"Cylinder", "Cylinder", "radius F 0.1|height F 0.2|bottom B 1|side B 1|top B 1|subdivision I 36"},
      {"Cone", "Cone", "bottomRadius F 0.1|height F 0.2|side B 1|bottom B 1|subdivision I 36"},
      {"Capsule", "Capsule", "radius F 0.1|height F 0.2|bottom B 1|side B 1|top B 1|subdivision I 36"},
      {"Plane", "Plane", "size 2 1 1"},
      {"IndexedFaceSet", "IndexedFaceSet", "coord N|coordIndex I*|ccw B 1|convex B 1|creaseAngle F 0"},
      {"IndexedLineSet", "IndexedLineSet", "coord N|coordIndex I*"},
      {"PointSet", "PointSet", "color N|coord N"},
      {"Coordinate", "Coordinate", "point V*"},
      {"Color", "Color", "color C*"},
      {"ElevationGrid", "ElevationGrid",
       "height F*|xDimension I 0|xSpacing F 1|zDimension I 0|zSpacing F 1|yDimension I 0|ySpacing F "
       "1|thickness F 1"},
  };
}

std::vector<KindRow> surroundings() {
  return {
      {"Physics", "Physics", "density F 1000|mass F -1|centerOfMass V*|inertiaMatrix V*|damping N"},
      {"WorldInfo", "WorldInfo",
       "info S*|title S|window S|gravity F 9.81|CFM F 0.00001|ERP F 0.2|physics S|basicTimeStep F 32|FPS F "
       "60|"
       "coordinateSystem S ENU|northDirection V 1 0 0|randomSeed I 0|contactProperties N*|gpsReference V 0 0 "
       "0"},
      {"ContactProperties", "ContactProperties",
       "material1 S default|material2 S default|coulombFriction F*|bounce F 0.5|bounceVelocity F "
       "0.01|softCFM F 0.001|"
       "softERP F 0.2"},
      {"Viewpoint", "Viewpoint",
       "fieldOfView F 0.785398|orientation R 0 0 1 0|position V -10 0 0|near F 0.05|far F 0|follow "
       "S|exposure F 1"},
      {"Background", "Background", "skyColor C*|luminosity F 1"},
      {"TexturedBackground", "Background", "texture S mountains|luminosity F 1|skyColor C*|skybox B 1"},
      {"TexturedBackgroundLight", "DirectionalLight", "texture S mountains|luminosity F 1|castShadows B 1"},
      {"PointLight", "PointLight", kLight + "attenuation V 1 0 0|location V 0 0 0.3|radius F 100"},
      {"SpotLight", "SpotLight",
       kLight + "attenuation V 1 0 0|location V 0 0 10|direction V 0 1 -1|beamWidth F 0.7|cutOffAngle F "
                "0.785398|radius F "
                "100"},
      {"DirectionalLight", "DirectionalLight", kLight + "direction V 0 0 -1"},
  };
}

std::vector<KindRow> joints() {
  return {
      {"HingeJoint", "HingeJoint", "device N*|jointParameters N|endPoint N"},
      {"SliderJoint", "SliderJoint", "device N*|jointParameters N|endPoint N"},
      {"HingeJointParameters", "HingeJointParameters",
       "position F 0|axis V 1 0 0|anchor V 0 0 0|minStop F 0|maxStop F 0"},
      {"JointParameters", "JointParameters", "position F 0|axis V 0 0 1|minStop F 0|maxStop F 0"},
      {"RotationalMotor", "RotationalMotor",
       "name S rotational motor|maxVelocity F 10|maxTorque F 10|minPosition F 0|maxPosition F 0|controlPID V "
       "10 0 0"},
      {"LinearMotor", "LinearMotor",
       "name S linear motor|maxVelocity F 10|maxForce F 10|minPosition F 0|maxPosition F 0|controlPID V 10 0 "
       "0"},
      {"PositionSensor", "PositionSensor", "name S position sensor|noise F 0|resolution F -1"},
  };
}

std::vector<KindRow> devices() {
  return {
      {"Emitter", "Emitter",
       named("emitter") +
           "|type S radio|range F -1|maxRange F -1|aperture F -1|channel I 0|baudRate I -1|byteSize I "
           "8|bufferSize I "
           "-1|allowedChannels I*"},
      {"Receiver", "Receiver",
       named("receiver") + "|type S radio|aperture F -1|channel I 0|baudRate I -1|byteSize I 8|bufferSize I "
                           "-1|signalStrengthNoise F "
                           "0|directionNoise F 0|allowedChannels I*"},
      {"Display", "Display", named("display") + "|width I 64|height I 64|windowPosition 2 0 0|pixelSize F 1"},
      {"Camera", "Camera",
       named("camera") + "|fieldOfView F 0.7854|width I 64|height I 64|near F 0.01|far F 0|recognition N"},
      {"Recognition", "Recognition",
       "maxRange F 100|maxObjects I -1|occlusion I 1|frameColor C 1 0 0|frameThickness I 1"},
      {"DistanceSensor", "DistanceSensor",
       named("distance sensor") +
           "|lookupTable V*|type S generic|numberOfRays I 1|aperture F 1.5708|gaussianWidth F "
           "1|resolution F -1"},
      {"LightSensor", "LightSensor",
       named("light sensor") + "|lookupTable V*|colorFilter C 1 1 1|occlusion B 0|resolution F -1"},
      {"GPS", "GPS", named("gps") + "|type S satellite|accuracy F 0|noiseCorrelation F 0|resolution F -1"},
      {"Compass", "Compass",
       named("compass") + "|lookupTable V*|xAxis B 1|yAxis B 1|zAxis B 1|resolution F -1"},
      {"Gyro", "Gyro", named("gyro") + "|lookupTable V*|xAxis B 1|yAxis B 1|zAxis B 1|resolution F -1"},
      {"Accelerometer", "Accelerometer",
       named("accelerometer") + "|lookupTable V*|xAxis B 1|yAxis B 1|zAxis B 1|resolution F -1"},
      {"InertialUnit", "InertialUnit",
       named("inertial unit") + "|lookupTable V*|xAxis B 1|yAxis B 1|zAxis B 1|noise F 0"},
      {"TouchSensor", "TouchSensor", named("touch sensor") + "|type S bumper|lookupTable V*"},
      {"LED", "LED", named("led") + "|color C*|gradual B 0"},
      {"Pen", "Pen",
       named("pen") + "|inkColor C 0 0 0|inkDensity F 0.5|leadSize F 0.002|maxDistance F 0|write B 1"},
      {"Speaker", "Speaker", named("speaker")},
  };
}

std::vector<KindRow> furniture() {
  return {
      {"RectangleArena", "Solid", kArena},
      {"CircleArena", "Solid",
       kPlaced + "|name S circle arena|radius F 1|subdivision I 48|floorAppearance N|wallThickness F "
                 "0.01|wallHeight F "
                 "0.1|wallAppearance N|contactMaterial S default"},
      {"Floor", "Solid",
       kPlaced + "|name S floor|size 2 10 10|tileSize 2 1 1|appearance N|contactMaterial S default"},
      {"Wall", "Solid", kBlock},
      {"WoodenBox", "Solid", kBlock},
      {"CardboardBox", "Solid", kBlock},
      {"MetalStorageBox", "Solid", kBlock},
      {"PlasticCrate", "Solid", kBlock},
      {"SolidBox", "Solid", kBlock},
      {"SolidPipe", "Solid", kBlock + "|radius F 0.05|height F 0.2|thickness F 0"},
      {"Obstacle", "Solid", kBlock + "|radius F 0.04|height F 0.05"},
      {"OilBarrel", "Solid", kBlock + "|radius F 0.305|height F 0.88"},
      {"WoodenBarrel", "Solid", kBlock + "|radius F 0.4|height F 1"},
      {"SoccerBall", "Solid", kBlock + "|radius F 0.1"},
      {"Ball", "Solid", kBlock + "|radius F 0.1"},
  };
}

const std::vector<KindRow>& kinds() {
  static const std::vector<KindRow> all = [] {
    std::vector<KindRow> joined;
    for (const auto subject : {bodies, shapes, surroundings, joints, devices, furniture})
      for (const KindRow& row : subject()) joined.push_back(row);
    return joined;
  }();
  return all;
}

int type_of_letter(const std::string& letters) {
  const std::string order = " BIF2VRCSN";
  const std::size_t at = order.find(letters[0]);
  return static_cast<int>(at) + (letters.size() > 1 ? kList : 0);
}

std::vector<FieldRow> read_rows(const std::string& text) {
  std::vector<FieldRow> rows;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, '|');) {
    std::istringstream words(part);
    FieldRow row;
    std::string letters;
    words >> row.name >> letters >> std::ws;
    row.type = type_of_letter(letters);
    if (row.type == kText)
      std::getline(words, row.text);
    else
      row.numbers.assign(std::istream_iterator<double>(words), std::istream_iterator<double>());
    if (!is_list(row.type)) row.numbers.resize(width_of(row.type));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// How the kind that `type` is called by is written in the table: robots of many names are e-pucks.
std::string plain_type(const std::string& type) {
  std::string t;
  for (const char c : type)
    if (c != '-' && c != '_') t += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return t.rfind("epuck", 0) == 0 && t.find("sensor") == std::string::npos &&
                 t.find("turret") == std::string::npos
             ? "E-puck"
             : type;
}

// as webots/nodes.h counts from 1
const char* const kKinds[] = {"Appearance",
                              "Background",
                              "Billboard",
                              "Box",
                              "CadShape",
                              "Capsule",
                              "Color",
                              "Cone",
                              "Coordinate",
                              "Cylinder",
                              "DirectionalLight",
                              "ElevationGrid",
                              "Fog",
                              "Group",
                              "ImageTexture",
                              "IndexedFaceSet",
                              "IndexedLineSet",
                              "Material",
                              "Mesh",
                              "Muscle",
                              "Normal",
                              "PBRAppearance",
                              "Plane",
                              "PointLight",
                              "PointSet",
                              "Pose",
                              "Shape",
                              "Sphere",
                              "SpotLight",
                              "TextureCoordinate",
                              "TextureTransform",
                              "Transform",
                              "Viewpoint",
                              "Robot",
                              "Accelerometer",
                              "Altimeter",
                              "Brake",
                              "Camera",
                              "Compass",
                              "Connector",
                              "Display",
                              "DistanceSensor",
                              "Emitter",
                              "GPS",
                              "Gyro",
                              "InertialUnit",
                              "LED",
                              "Lidar",
                              "LightSensor",
                              "LinearMotor",
                              "Pen",
                              "PositionSensor",
                              "Propeller",
                              "Radar",
                              "RangeFinder",
                              "Receiver",
                              "RotationalMotor",
                              "Skin",
                              "Speaker",
                              "TouchSensor",
                              "VacuumGripper",
                              "BallJoint",
                              "BallJointParameters",
                              "Charger",
                              "ContactProperties",
                              "Damping",
                              "Fluid",
                              "Focus",
                              "HingeJoint",
                              "HingeJointParameters",
                              "Hinge2Joint",
                              "ImmersionProperties",
                              "JointParameters",
                              "Lens",
                              "LensFlare",
                              "Physics",
                              "Recognition",
                              "SliderJoint",
                              "Slot",
                              "Solid",
                              "SolidReference",
                              "Track",
                              "TrackWheel",
                              "WorldInfo",
                              "Zoom",
                              "Microphone",
                              "Radio",
                              "Supervisor"};

}  // namespace

std::string field_type_name(int type) {
  static const char* const kNames[] = {"",      "Bool",     "Int32", "Float",  "Vec2f",
                                       "Vec3f", "Rotation", "Color", "String", "Node"};
  const int member = member_of(type);
  if (member <= kNoField || member > kNode) return "";
  return (is_list(type) ? "MF" : "SF") + std::string(kNames[member]);
}

const std::vector<FieldRow>& fields_of(const std::string& type) {
  static const std::map<std::string, std::vector<FieldRow>> all = [] {
    std::map<std::string, std::vector<FieldRow>> made;
    for (const KindRow& k : kinds()) made[k.type] = read_rows(k.fields);
    return made;
  }();
  static const std::vector<FieldRow> none;
  const auto found = all.find(plain_type(type));
  return found == all.end() ? none : found->second;
}

int usual_field_type(const std::string& name) {
  static const std::map<std::string, int> all = [] {
    std::map<std::string, int> made;
    for (const KindRow& k : kinds())
      for (const FieldRow& row : fields_of(k.type)) made.emplace(row.name, row.type);
    return made;
  }();
  const auto found = all.find(name);
  return found == all.end() ? kNoField : found->second;
}

std::string base_of(const std::string& type) {
  const std::string plain = plain_type(type);
  for (const KindRow& k : kinds())
    if (plain == k.type) return k.base;
  return type;
}

int kind_number(const std::string& base) {
  const auto found = std::find(std::begin(kKinds), std::end(kKinds), base);
  return found == std::end(kKinds) ? 0 : static_cast<int>(found - std::begin(kKinds)) + 1;
}

}  // namespace programs
