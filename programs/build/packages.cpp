// SPDX-License-Identifier: MIT
// Which package of Debian a missing header, library or Python module is in.
#include <array>

#include "build.h"
#include "sim_core/base/pattern.h"

namespace programs {
namespace {

/// What programs for robots ask for, and where Debian has it; "" for what it has not.
struct Package {
  const char* name;     // as people say it
  const char* header;   // how names of its headers begin
  const char* library;  // how names behind -l begin
  const char* debian;
};
constexpr std::array kPackages = {
    Package{"gsl", "gsl/", "gsl", "libgsl-dev"},
    Package{"opencv", "opencv", "opencv", "libopencv-dev"},
    Package{"opencv", "cv.h", "", "libopencv-dev"},
    Package{"opencv", "highgui.h", "", "libopencv-dev"},
    Package{"eigen", "Eigen/", "", "libeigen3-dev"},
    Package{"eigen", "eigen3/", "", "libeigen3-dev"},
    Package{"boost", "boost/", "boost", "libboost-all-dev"},
    Package{"armadillo", "armadillo", "armadillo", "libarmadillo-dev"},
    Package{"json", "nlohmann/", "", "nlohmann-json3-dev"},
    Package{"json", "json/", "jsoncpp", "libjsoncpp-dev"},
    Package{"json-c", "json-c/", "json-c", "libjson-c-dev"},
    Package{"yaml", "yaml-cpp/", "yaml-cpp", "libyaml-cpp-dev"},
    Package{"tinyxml2", "tinyxml2.h", "tinyxml2", "libtinyxml2-dev"},
    Package{"libxml2", "libxml/", "xml2", "libxml2-dev"},
    Package{"curl", "curl/", "curl", "libcurl4-openssl-dev"},
    Package{"zmq", "zmq", "zmq", "libzmq3-dev"},
    Package{"mosquitto", "mosquitto", "mosquitto", "libmosquitto-dev"},
    Package{"sqlite", "sqlite3.h", "sqlite3", "libsqlite3-dev"},
    Package{"ncurses", "ncurses", "ncurses", "libncurses-dev"},
    Package{"ncurses", "curses.h", "curses", "libncurses-dev"},
    Package{"readline", "readline/", "readline", "libreadline-dev"},
    Package{"fftw", "fftw3.h", "fftw3", "libfftw3-dev"},
    Package{"lapack", "lapacke.h", "lapack", "liblapack-dev liblapacke-dev"},
    Package{"blas", "cblas.h", "blas", "libblas-dev"},
    Package{"blas", "", "cblas", "libblas-dev"},
    Package{"ode", "ode/", "ode", "libode-dev"},
    Package{"fann", "fann", "fann", "libfann-dev"},
    Package{"fann", "doublefann", "doublefann", "libfann-dev"},
    Package{"SDL2", "SDL2/", "SDL2", "libsdl2-dev"},
    Package{"SDL", "SDL/", "SDL", "libsdl1.2-dev"},
    Package{"glut", "GL/glut.h", "glut", "freeglut3-dev"},
    Package{"OpenGL", "GL/", "GL", "libgl-dev libglu1-mesa-dev"},
    Package{"X11", "X11/", "X11", "libx11-dev"},
    Package{"gtk", "gtk/", "gtk", "libgtk-3-dev"},
    Package{"glib", "glib.h", "glib-2", "libglib2.0-dev"},
    Package{"png", "png.h", "png", "libpng-dev"},
    Package{"jpeg", "jpeglib.h", "jpeg", "libjpeg-dev"},
    Package{"zlib", "zlib.h", "z", "zlib1g-dev"},
    Package{"openssl", "openssl/", "ssl", "libssl-dev"},
    Package{"openssl", "", "crypto", "libssl-dev"},
    Package{"protobuf", "google/protobuf/", "protobuf", "libprotobuf-dev protobuf-compiler"},
    Package{"fmt", "fmt/", "fmt", "libfmt-dev"},
    Package{"spdlog", "spdlog/", "spdlog", "libspdlog-dev"},
    Package{"Qt", "QtCore", "Qt5", "qtbase5-dev"},
    Package{"Python", "Python.h", "python3", "python3-dev"},
    Package{"Lua", "lua", "lua", "liblua5.4-dev"},
    Package{"tbb", "tbb/", "tbb", "libtbb-dev"},
    Package{"pcl", "pcl/", "pcl", "libpcl-dev"},
    Package{"muParser", "muParser.h", "muparser", "libmuparser-dev"},
    Package{"libevent", "event2/", "event", "libevent-dev"},
    Package{"ros", "ros/", "roscpp", ""},
    Package{"ros", "rclcpp/", "rclcpp", ""},
};

struct Module {
  const char* name;    // as it is imported
  const char* debian;  // "": pip has it
};
constexpr std::array kModules = {
    Module{"numpy", "python3-numpy"},
    Module{"scipy", "python3-scipy"},
    Module{"matplotlib", "python3-matplotlib"},
    Module{"mpl_toolkits", "python3-matplotlib"},
    Module{"cv2", "python3-opencv"},
    Module{"pandas", "python3-pandas"},
    Module{"sklearn", "python3-sklearn"},
    Module{"skimage", "python3-skimage"},
    Module{"PIL", "python3-pil"},
    Module{"yaml", "python3-yaml"},
    Module{"requests", "python3-requests"},
    Module{"networkx", "python3-networkx"},
    Module{"shapely", "python3-shapely"},
    Module{"sympy", "python3-sympy"},
    Module{"seaborn", "python3-seaborn"},
    Module{"deap", "python3-deap"},
    Module{"tkinter", "python3-tk"},
    Module{"tqdm", "python3-tqdm"},
    Module{"transforms3d", "python3-transforms3d"},
    Module{"pyqtgraph", "python3-pyqtgraph"},
    Module{"PyQt5", "python3-pyqt5"},
    Module{"serial", "python3-serial"},
    Module{"zmq", "python3-zmq"},
    Module{"paho", "python3-paho-mqtt"},
    Module{"pygame", "python3-pygame"},
    Module{"numba", "python3-numba"},
    Module{"cvxopt", "python3-cvxopt"},
    Module{"flask", "python3-flask"},
    Module{"websockets", "python3-websockets"},
    Module{"websocket", "python3-websocket"},
    Module{"lxml", "python3-lxml"},
    Module{"joblib", "python3-joblib"},
    Module{"h5py", "python3-h5py"},
    Module{"bs4", "python3-bs4"},
    Module{"psutil", "python3-psutil"},
    Module{"dateutil", "python3-dateutil"},
    Module{"tensorflow", ""},
    Module{"torch", ""},
    Module{"torchvision", ""},
    Module{"keras", ""},
    Module{"gym", ""},
    Module{"gymnasium", ""},
    Module{"stable_baselines3", ""},
    Module{"deepbots", ""},
    Module{"neat", ""},
    Module{"ikpy", ""},
    Module{"keyboard", ""},
    Module{"pynput", "python3-pynput"},
    Module{"rospy", ""},
    Module{"rclpy", ""},
    Module{"vehicle", ""},
};
/// Modules whose package of pip has another name.
constexpr std::array kOtherNames = {Module{"neat", "neat-python"},
                                    Module{"stable_baselines3", "stable-baselines3"}};

std::string install(const std::string& name, const std::string& debian) {
  return name + ": " +
         (debian.empty() ? "Debian has no package of it, and its project says how it is installed"
                         : "apt install " + debian);
}

std::string of_header(const std::string& header) {
  for (const Package& p : kPackages)
    if (*p.header && header.rfind(p.header, 0) == 0) return install(p.name, p.debian);
  return "";
}

std::string of_library(const std::string& library) {
  // the longest beginning counts: -lglut is not OpenGL's -lGL, and -lz not -lzmq
  const Package* best = nullptr;
  for (const Package& p : kPackages)
    if (*p.library && library.rfind(p.library, 0) == 0 &&
        (std::char_traits<char>::length(p.library) > 2 || library == p.library) &&
        (!best || std::char_traits<char>::length(p.library) > std::char_traits<char>::length(best->library)))
      best = &p;
  return best ? install(best->name, best->debian) : "";
}

std::string of_module(const std::string& module) {
  const std::string top = module.substr(0, module.find('.'));
  if (top == "rospy" || top == "rclpy" || top == "vehicle") return "";  // no package brings these
  for (const Module& m : kModules) {
    if (top != m.name) continue;
    if (*m.debian) return install(top, m.debian);
    std::string package = top;
    for (const Module& other : kOtherNames)
      if (top == other.name) package = other.debian;
    return top + ": pip install " + package +
           " (in a virtual environment: python3 -m venv venv beside the program)";
  }
  return "";
}

}  // namespace

std::string package_hint(const std::string& line) {
  constexpr std::size_t kLongest = 2000;  // what a library names is near the beginning
  const std::string text = line.substr(0, kLongest);
  static const sim::Pattern kHeader(R"((?:fatal error|error): ([^ :]+): No such file or directory)"),
      kLibrary(R"(cannot find -l([^ :]+))"), kModule(R"(No module named '?([\w.]+)'?)"),
      kPkgConfig(R"(Package '?([\w.+-]+)'?,? (?:was not found|required by|not found))");
  std::smatch m;
  if (std::regex_search(text, m, kHeader)) return of_header(m[1]);
  if (std::regex_search(text, m, kLibrary)) return of_library(m[1]);
  if (std::regex_search(text, m, kPkgConfig)) return of_library(m[1]);
  if (std::regex_search(text, m, kModule)) return of_module(m[1]);
  return "";
}

}  // namespace programs
