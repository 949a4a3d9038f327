// One view of models of triangles: the exact method against VTK with Mesa's llvmpipe, which computes on the processor,
// too. Both draw 640x480 pixels of 4 samples from the same place, with the same triangles, normals, colours and
// textures, and hand the picture over; the share of pixels in which their outlines differ is printed beside the times.
// VTK has the triangles as its own buffers since a frame before, and lights corners; ours begins with the model each
// time.
//
//   bench_models_by_vtk [measure]
//
// Runs itself under xvfb-run, with one thread and with all. VTK's window needs an X server, though it stays invisible.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <thread>

#include "multiview/scene_around_model.h"
#include "stopwatch.h"
#include "wheatstone/depth/camera.h"
#include "wheatstone/multiview/render_model.h"
#include "wheatstone/synthetic/synthetic_models.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2);

using namespace wheatstone;

namespace {

constexpr int width = 640, height = 480;

vtkNew<vtkPoints> points_of(const Model& model, const ModelScene& scene) {
  vtkNew<vtkPoints> points;
  for (const auto& at : model.positions)
    points->InsertNextPoint(at[0] - scene.origin[0], at[1] - scene.origin[1], at[2] - scene.origin[2]);
  return points;
}

vtkNew<vtkPolyData> triangles_of(const Model& model, std::size_t material, vtkPoints* points) {
  vtkNew<vtkCellArray> cells;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.material_of[t] != material) continue;
    const auto& [a, b, c] = model.triangles[t];
    const std::array<vtkIdType, 3> corners{a, b, c};
    cells->InsertNextCell(3, corners.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const auto& normal : model.normals) normals->InsertNextTuple(normal.data());
  data->GetPointData()->SetNormals(normals);
  if (!model.colours.empty()) {
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    for (const Rgb8 colour : model.colours) colours->InsertNextTuple3(colour.r, colour.g, colour.b);
    data->GetPointData()->SetScalars(colours);
  }
  if (!model.texture_places.empty()) {
    vtkNew<vtkFloatArray> places;
    places->SetNumberOfComponents(2);
    for (const auto& place : model.texture_places) places->InsertNextTuple(place.data());
    data->GetPointData()->SetTCoords(places);
  }
  return data;
}

vtkNew<vtkTexture> texture_of(const Image<Rgb8>& picture) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width(), picture.height(), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      auto* to = static_cast<unsigned char*>(image->GetScalarPointer(x, picture.height() - 1 - y, 0));
      const Rgb8 pixel = picture(x, y);
      to[0] = pixel.r;
      to[1] = pixel.g;
      to[2] = pixel.b;
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOn();
  return texture;
}

/// A window that nobody sees, in which a model is.
class VtkView {
 public:
  VtkView(const Model& model, const ModelScene& scene) : samples_(scene.look.samples) {
    const vtkNew<vtkPoints> points = points_of(model, scene);
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(triangles_of(model, i, points));
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      const auto& [red, green, blue] = model.materials[i].colour;
      actor->GetProperty()->SetColor(static_cast<double>(red), static_cast<double>(green), static_cast<double>(blue));
      if (model.materials[i].texture >= 0)
        actor->SetTexture(texture_of(model.textures[static_cast<std::size_t>(model.materials[i].texture)]));
      renderer_->AddActor(actor);
    }
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(scene.look.samples);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    const Camera& from = scene.camera;
    vtkCamera& camera = *renderer_->GetActiveCamera();
    std::array<double, 3> at{}, to{}, up{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = static_cast<double>(from.position[axis]);
      to[axis] = at[axis] + static_cast<double>(from.forward[axis]);
      up[axis] = -static_cast<double>(from.down[axis]);
    }
    camera.SetPosition(at.data());
    camera.SetFocalPoint(to.data());
    camera.SetViewUp(up.data());
    camera.SetViewAngle(2 * std::atan(0.5 * height / static_cast<double>(from.focal_px)) * 180 / std::numbers::pi);
    renderer_->ResetCameraClippingRange();
    renderer_->SetBackground(0, 0, 0);
  }

  /// Whether the processor draws, with as many samples as ours.
  bool is_as_asked() {
    const std::string capabilities = window_->ReportCapabilities();
    return capabilities.find("llvmpipe") != std::string::npos && window_->GetMultiSamples() == samples_;
  }

  /// The picture, from the lowest row up.
  const vtkUnsignedCharArray& draw() {
    window_->Render();
    window_->GetPixelData(0, 0, width - 1, height - 1, 0, pixels_);
    return *pixels_;
  }

 private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkUnsignedCharArray> pixels_;
  int samples_;
};

/// The share of pixels that show the model in one picture and nothing of it in the other, in percent.
double outlines_differ(const Image<Rgb8>& ours, const vtkUnsignedCharArray& theirs) {
  int differ = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vtkIdType at = 3 * (static_cast<vtkIdType>(height - 1 - y) * width + x);
      const bool is_theirs = theirs.GetValue(at) + theirs.GetValue(at + 1) + theirs.GetValue(at + 2) > 0;
      differ += is_theirs != (ours(x, y) != Rgb8{0, 0, 0}) ? 1 : 0;
    }
  }
  return 100. * differ / (width * height);
}

bool compare(const std::string& name, const Model& model) {
  constexpr int runs = 7;
  ModelScene scene = bench::scene_around(model, width, height);
  scene.look.background = {0, 0, 0};
  const Rig one = evenly_spaced(width, height, 1);
  Image<Rgb8> ours;
  const double our_s = bench::least_processor_seconds(
      [&] { ours = render_model(model, scene, one, {.method = Method::exact}).views[0]; }, runs);
  VtkView view(model, scene);
  view.draw();
  const double vtk_s = bench::least_processor_seconds([&] { view.draw(); }, runs);
  const double differ = outlines_differ(ours, view.draw());
  fmt::print("{:>7} {:>10} {:>10.1f} {:>9.1f} {:>6.2f} {:>15.2f} %\n", name, model.triangles.size(), 1000 * vtk_s,
             1000 * our_s, vtk_s / our_s, differ);
  constexpr double most_percent = 2;  // thin leaves
  return differ < most_percent && view.is_as_asked();
}

int measure() {
  const unsigned threads =
      std::getenv("LP_NUM_THREADS") != nullptr ? 1 : std::max(std::thread::hardware_concurrency(), 1u);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  fmt::print("{} thread{}; ms of processor time, user and system, for a view\n", threads, threads == 1 ? "" : "s");
  fmt::print("{:>7} {:>10} {:>10} {:>9} {:>6} {:>17}\n", "model", "triangles", "VTK", "exact", "ratio",
             "outlines differ");
  bool is_alike = true;
  for (const std::size_t triangles : {1'000u, 10'000u, 100'000u, 1'000'000u})
    is_alike = compare("knot", make_knot(triangles)) && is_alike;
  is_alike = compare("tree", make_tree(100'000)) && is_alike;
  is_alike = compare("sphere", make_textured_sphere(100'000)) && is_alike;
  is_alike = compare("city", make_city(100'000)) && is_alike;
  return is_alike ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) return measure();
  if (std::system("command -v xvfb-run > /dev/null") != 0) {
    fmt::print("models by VTK: xvfb-run is not installed\n");
    return 0;
  }
  const std::string run = fmt::format("xvfb-run -a '{}' measure", argv[0]);
  for (const std::string threads : {"LP_NUM_THREADS=0 ", ""})
    if (std::system((threads + run).c_str()) != 0) return 1;
  return 0;
}
