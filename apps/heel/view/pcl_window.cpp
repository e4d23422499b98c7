// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/view/view_scene.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <pcl/common/point_tests.h>
#include <pcl/visualization/pcl_visualizer.h>
#include <vtkObject.h>

#include <algorithm>
#include <chrono>
#include <string>

// The last, for it has a macro "Status", which is a class of VTK's.
#include <X11/Xlib.h>

namespace heel {

namespace {

using Clock = std::chrono::steady_clock;

struct Rgb {
  double r, g, b;
};

Rgb rgbOf(const cv::Scalar& bgr) { return {bgr[2] / 255.0, bgr[1] / 255.0, bgr[0] / 255.0}; }

pcl::PointXYZ point(const Eigen::Vector2d& at, double z) {
  return {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(z)};
}

class PclWindow final : public SceneWindow {
 public:
  PclWindow() : viewer_("heel") {
    vtkObject::GlobalWarningDisplayOff();  // of what PCL still uses
    const Rgb panel = rgbOf(palette::kPanel);
    viewer_.setBackgroundColor(panel.r, panel.g, panel.b);
    viewer_.setSize(960, 720);
    viewer_.addCoordinateSystem(0.3);
  }

  bool show(const ViewScene& scene, double seconds) override {
    if (!has_view_) look(scene);
    showPoints(scene);
    viewer_.setCameraClipDistances(0.05, 100.0);  // PCL's are those of the first cloud
    viewer_.removeAllShapes();
    for (const DrawnBlob& blob : scene.drawn.blobs) addBlob(blob);
    for (const DrawnTrack& track : scene.drawn.tracks) addTrack(track);
    viewer_.addText(scene.drawn.state + "  " + scene.drawn.reason, 12, 12, 16, 0.94, 0.92, 0.9,
                    "state");
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    do {
      viewer_.spinOnce(10);
    } while (!viewer_.wasStopped() && Clock::now() < end);
    return !viewer_.wasStopped();
  }

 private:
  void look(const ViewScene& scene) {
    const ViewPoint from = behindCamera(scene.drawn.T_floor_camera);
    viewer_.setCameraPosition(from.eye_m.x(), from.eye_m.y(), from.eye_m.z(), from.target_m.x(),
                              from.target_m.y(), from.target_m.z(), 0.0, 0.0, 1.0);
    addPoints(*wallPoints(scene.walls), 3.0, "walls");
    has_view_ = true;
  }

  void showPoints(const ViewScene& scene) {
    viewer_.removePointCloud("cloud");
    addPoints(*tintedCloud(scene), 2.0, "cloud");
  }

  /// Those that have a place: of others, VTK makes points in odd places.
  void addPoints(const ColorCloud& cloud, double size_px, const char* id) {
    const auto placed = pcl::make_shared<ColorCloud>();
    for (const auto& point : cloud) {
      if (pcl::isFinite(point)) placed->push_back(point);
    }
    if (placed->empty()) return;
    const pcl::visualization::PointCloudColorHandlerRGBField<pcl::PointXYZRGB> colors(placed);
    viewer_.addPointCloud<pcl::PointXYZRGB>(placed, colors, id);
    viewer_.setPointCloudRenderingProperties(pcl::visualization::PCL_VISUALIZER_POINT_SIZE, size_px,
                                             id);
  }

  void addBlob(const DrawnBlob& blob) {
    const Rgb color = rgbOf(blob.is_used ? palette::kBlob : palette::kGatedOut);
    viewer_.addSphere(point(blob.position_m, 0.0), 0.1, color.r, color.g, color.b, name("blob"));
  }

  void addTrack(const DrawnTrack& track) {
    const Rgb color = rgbOf(track.is_target ? palette::kTarget : palette::kTrack);
    viewer_.addLine(point(track.position_m, 0.0), point(track.position_m, track.height_m), color.r,
                    color.g, color.b, name("pole"));
    viewer_.addSphere(point(track.position_m, track.height_m), track.is_target ? 0.1 : 0.06,
                      color.r, color.g, color.b, name("head"));
    for (std::size_t i = 1; i < track.trail_m.size(); ++i) {
      viewer_.addLine(point(track.trail_m[i - 1], 0.0), point(track.trail_m[i], 0.0), color.r,
                      color.g, color.b, name("trail"));
    }
    viewer_.addText3D(track.is_target ? "target" : "#" + std::to_string(track.id),
                      point(track.position_m, track.height_m + 0.15), 0.12, color.r, color.g,
                      color.b, name("label"));
  }

  std::string name(const char* kind) { return kind + std::to_string(next_name_++); }

  pcl::visualization::PCLVisualizer viewer_;
  bool has_view_ = false;
  std::size_t next_name_ = 0;
};

}  // namespace

}  // namespace heel

/// @return nullptr if there is no display; VTK would end the program.
extern "C" heel::SceneWindow* heelOpenSceneWindow() {
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return nullptr;
  int first_error = 0, first_event = 0, opcode = 0;
  const bool has_opengl = XQueryExtension(display, "GLX", &opcode, &first_event, &first_error) != 0;
  XCloseDisplay(display);
  return has_opengl ? new heel::PclWindow : nullptr;
}
