// Particles to sixteen views by the graphics processor: against the processor, and against drawing points into a
// framebuffer of sixteen layers.
//
//   bench_gpu [PARTICLES]     1 million unless told otherwise

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "stopwatch.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/random.h"

namespace wheatstone::bench {
namespace {

constexpr int views = 16, width = 420, height = 560;

struct Workload {
  Cloud cloud;
  CloudStatistics statistics;
  Scene scene;
  Rig rig = evenly_spaced(width, height, views);
};

Workload workload_of(std::size_t particles, float splat_px) {
  Workload work;
  for (std::size_t i = 0; i < particles; ++i) {
    const auto at = [i](std::uint64_t axis) { return unit_float(hash_keys({i, axis})); };
    work.cloud.x.push_back(at(0));
    work.cloud.y.push_back(at(1));
    work.cloud.z.push_back(at(2));
    work.cloud.density.push_back(0.5f + at(3));
  }
  work.statistics.add(work.cloud);
  work.scene.camera = camera_around(work.statistics.centre(), work.statistics.radius(), width, height);
  work.scene.mapping.points = {{1, -15}, {4, 15}};
  Appearance appearance{.look = Look::thesis};
  appearance.smallest_px = appearance.largest_px = splat_px;
  work.scene.splat_style = make_splat_style(appearance, work.statistics);
  return work;
}

std::vector<Image<Rgb8>> views_of(const Workload& work, Method method, Device device) {
  const RenderOptions options{.method = method, .device = device, .exposure = 0.5f};
  return render(chunks_of(work.cloud), work.statistics, work.scene, work.rig, options).views;
}

constexpr const char* point_source = R"(#version 450
#extension GL_ARB_shader_viewport_layer_array : require
layout(location = 0) in vec3 at;  // in the view, 0..1, and the parallax
void main() {
  gl_Layer = gl_InstanceID;
  gl_Position = vec4(2 * at.x - 1 + at.z * (gl_InstanceID - 7.5) / 15, 2 * at.y - 1, 0, 1);
})";
constexpr const char* light_source = R"(#version 450
out vec4 light;
void main() { light = vec4(0.1); })";

/// Splats as we draw them: a Gaussian in colour, as wide.
constexpr const char* splat_source = R"(#version 450
#extension GL_ARB_shader_viewport_layer_array : require
layout(location = 0) in vec3 at;
uniform float size;
out vec3 colour;
void main() {
  gl_Layer = gl_InstanceID;
  gl_Position = vec4(2 * at.x - 1 + at.z * (gl_InstanceID - 7.5) / 15, 2 * at.y - 1, 0, 1);
  gl_PointSize = size + 1;
  colour = vec3(at.xy, 0.5);
})";
constexpr const char* gaussian_source = R"(#version 450
uniform float size;
in vec3 colour;
out vec4 light;
void main() {
  vec2 away = (gl_PointCoord - 0.5) * (size + 1);
  light = vec4(colour * exp2(-0.72134752 / (size * size / 25 + 1.0 / 12) * dot(away, away)), 0);
})";

/// What is drawn into the layers, and what they hold.
struct Points {
  const char *vertex, *fragment;
  GLenum format;
  float size;
};

GLuint program_of(const Points& points) {
  const GLuint program = glCreateProgram();
  for (const auto& [kind, source] :
       {std::pair{GL_VERTEX_SHADER, points.vertex}, std::pair{GL_FRAGMENT_SHADER, points.fragment}}) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) throw Error(ErrorKind::wrong_usage, "the driver does not draw points into layers");
  return program;
}

/// Draws each particle into every layer of a framebuffer of floats, with additive blending.
double seconds_of_layers(const Workload& work, const Points& drawn) {
  std::vector<float> points;
  for (std::size_t i = 0; i < work.cloud.size(); ++i)
    points.insert(points.end(), {work.cloud.x[i], work.cloud.y[i], 0.05f * work.cloud.z[i]});
  double seconds = 0;
  on_gpu([&](const GpuFacts&) {
    const GLuint program = program_of(drawn);
    GLuint buffer = 0, vertices = 0, texture = 0, frame = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(points.size() * sizeof(float)), points.data(), 0);
    glCreateVertexArrays(1, &vertices);
    glVertexArrayVertexBuffer(vertices, 0, buffer, 0, 3 * sizeof(float));
    glEnableVertexArrayAttrib(vertices, 0);
    glVertexArrayAttribFormat(vertices, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &texture);
    glTextureStorage3D(texture, 1, drawn.format, width, height, views);
    glCreateFramebuffers(1, &frame);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glBindVertexArray(vertices);
    glUseProgram(program);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glProgramUniform1f(program, glGetUniformLocation(program, "size"), drawn.size);
    glViewport(0, 0, width, height);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    seconds = median_seconds(
        [&] {
          glClear(GL_COLOR_BUFFER_BIT);
          glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(work.cloud.size()), views);
          glFinish();
        },
        1);
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &frame);
    glDeleteTextures(1, &texture);
    glDeleteVertexArrays(1, &vertices);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
  });
  return seconds;
}

double copied_bytes_a_second() {
  std::vector<char> from(std::size_t{1} << 28, 1);
  std::vector<char> to(from.size());
  return 2 * static_cast<double>(from.size()) /
         median_seconds([&] { std::memcpy(to.data(), from.data(), from.size()); });
}

/// Lists that a splat stands in: those of its rows, two by two.
double lists_of(float splat_px) { return (splat_px + 2) / 2; }

/// Bytes that particles, splats and lists have on their way through memory, before any view: four columns, a splat that
/// is written and read twice, an entry for each list, and its number.
double bytes_of_sorting(std::size_t particles, float splat_px) {
  return static_cast<double>(particles) * (4 * 4 + 3 * 32 + lists_of(splat_px) * (32 + 2 * 4));
}

/// Bytes of a view: every list once, and light that is written, read and shown.
double bytes_of_view(std::size_t particles, float splat_px) {
  return static_cast<double>(particles) * lists_of(splat_px) * 32 + width * height * (2 * 12 + 4.0);
}

/// Seconds of the processor and of the graphics processor by one method.
struct Times {
  double cpu, gpu;
};

/// Seconds of a framebuffer of sixteen layers: of one number a particle, and of splats as ours.
struct Layers {
  double points, splats;
};

Times compare(const Workload& work, const char* name, Method method, const Layers& layers) {
  const std::vector<Image<Rgb8>> expected = views_of(work, method, Device::processor);
  const std::vector<Image<Rgb8>> found = views_of(work, method, Device::graphics);
  double psnr = std::numeric_limits<double>::infinity();
  for (int v = 0; v < views; ++v) psnr = std::min(psnr, measure_view(found[v], expected[v]).psnr_db);
  const Times times{median_seconds([&] { views_of(work, method, Device::processor); }, 3),
                    median_seconds([&] { views_of(work, method, Device::graphics); }, 3)};
  fmt::print(
      "    {:<11} {:7.3f} s, {:5.2f} times the processor's {:.3f} s; {:.1f} million particles x views a second; "
      "{:.1f} dB at least; a framebuffer of {} layers takes {:.1f} times as long, and {:.1f} times of bare points\n",
      name, times.gpu, times.gpu / times.cpu, times.cpu,
      static_cast<double>(work.cloud.size()) * views / times.gpu / 1e6, psnr, views, layers.splats / times.gpu,
      layers.points / times.gpu);
  return times;
}

/// The incremental way against the exact one, each of whose views projects and sorts for itself (Hassaine 2010, ch. 4).
void compare_with_exact(Workload work, float splat_px, double copy) {
  const std::vector<ViewPosition> all = work.rig.positions;
  const double sorting = bytes_of_sorting(work.cloud.size(), splat_px);
  const double a_view = bytes_of_view(work.cloud.size(), splat_px);
  fmt::print(
      "    views   exact: s   MB a view   incremental: s   MB a view   copies of memory a second: exact, "
      "incremental\n");
  for (const int count : {1, 2, 4, 16}) {
    work.rig.positions.assign(all.begin(), all.begin() + count);
    const double together = median_seconds([&] { views_of(work, Method::incremental, Device::graphics); }, 1);
    const double alone = median_seconds(
        [&] {
          for (int v = 0; v < count; ++v) {
            work.rig.positions = {all[static_cast<std::size_t>(v)]};
            views_of(work, Method::incremental, Device::graphics);
          }
        },
        1);
    const double exact_bytes = count * (sorting + a_view);
    const double bytes = sorting + count * a_view;
    fmt::print("    {:5} {:10.3f} {:11.0f} {:16.3f} {:11.0f} {:24.4f} {:12.4f}\n", count, alone,
               exact_bytes / count / 1e6, together, bytes / count / 1e6, exact_bytes / alone / copy,
               bytes / together / copy);
  }
}

void compare(std::size_t particles, float splat_px, double points, double copy) {
  const Workload work = workload_of(particles, splat_px);
  const Layers layers{points, seconds_of_layers(work, {splat_source, gaussian_source, GL_RGBA32F, splat_px})};
  fmt::print("  splats of {:.0f} px; the same in a framebuffer of {} layers, three numbers a pixel: {:.2f} s\n",
             splat_px, views, layers.splats);
  const Times incremental = compare(work, "incremental", Method::incremental, layers);
  const Times layered = compare(work, "layered", Method::layered, layers);
  const double gpu = std::min(incremental.gpu, layered.gpu), cpu = std::min(incremental.cpu, layered.cpu);
  fmt::print("    the faster one of each: {:.2f} times the processor's\n", gpu / cpu);
  compare_with_exact(work, splat_px, copy);
}

void run(std::size_t particles) {
  const GpuFacts facts = gpu_facts();
  fmt::print("{} particles, {} views of {}x{}, on {}\n", particles, views, width, height, facts.name);
  const double copy = copied_bytes_a_second();
  const double points = seconds_of_layers(workload_of(particles, 1), {point_source, light_source, GL_R32F, 1});
  fmt::print("  points of one pixel into a framebuffer of {} layers, one number a pixel: {:.2f} s\n", views, points);
  compare(particles, 1, points, copy);
  compare(particles, 4, points, copy);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  try {
    wheatstone::bench::run(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000);
  } catch (const wheatstone::Error& error) {
    fmt::print("bench_gpu: {}\n", error.what());
  }
}
