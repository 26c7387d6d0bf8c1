#include "viewer/headless/screenshot.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <limits>
#include <numbers>
#include <thread>

#include <curveskel/error.hpp>
#include <curveskel/view.hpp>
#include "app/output_files.hpp"
#include "viewer/headless/headless.hpp"
#include "viewer/headless/open_for_pictures.hpp"
#include "viewer/headless/png.hpp"
#include "viewer/model/ground.hpp"
#include "viewer/model/rigging.hpp"

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;
using Part = Renderer::Part;

/// Beyond this the driver's largest picture may be passed.
constexpr int largest_side = 16384;

void add_rig(Scene& scene, const RunOptions& options, const Monitor& monitor) {
  ExtractionCache cache;
  scene.recording.add(moment_of(rig_of_surface(scene.document, options, monitor, cache).character));
}

/// Of the skeleton that was opened, as the window makes it.
void add_rig_of_file(Scene& scene, const RunOptions& options, const Monitor& monitor) {
  const auto ground =
      ground_of(repaired_of(scene.document, nullptr, options.repair, monitor), monitor);
  const CurveSkeleton& skeleton = *scene.own_skeleton;
  const Certificate certificate =
      certificate_of(*ground, skeleton, options.extract.certificate, monitor);
  CharacterOptions character = options.character;
  character.rig.joints.root = scene.document.root;
  scene.recording.add(moment_of(
      rig_of(scene.document, *ground->repaired, skeleton, &certificate, character, monitor)));
}

/// Waits for the run; the scene's recording has all of it then.
void finish_run(Scene& scene, const ViewOptions& options, const Monitor& monitor) {
  Run run(scene.document.polygons(), options.pipeline, scene.document.space,
          std::make_shared<RunMemory>(), false);
  for (;;) {
    Run::News news = run.take();
    for (Moment& moment : news.moments) scene.recording.add(std::move(moment));
    if (news.state == Run::State::failed) throw Error(news.fault, news.error);
    if (news.state == Run::State::finished) {
      scene.recording.settle(news.result->extraction->history);
      return;
    }
    monitor.report(news.stage.empty() ? "start" : news.stage, news.fraction);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// As the command line calls it.
std::string name_of(const StageWish& wish) {
  return wish.stage == "fair" ? "fairing" : wish.stage == "contract" ? "contraction" : wish.stage;
}

void go_to(Scene& scene, const StageWish& wish) {
  const auto& moments = scene.recording.moments();
  int last = -1;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (moments[i].stage != wish.stage) continue;
    last = std::max(last, moments[i].iteration);
    if (wish.iteration < 0 || moments[i].iteration <= wish.iteration) scene.moment = i;
  }
  if (last < 0) {
    throw Error(Fault::input, "the stage " + name_of(wish) +
                                  " never came; a run over a surface has input, contraction:K, "
                                  "surgery, skeleton, rig, and fairing:K with --fair N");
  }
  if (wish.iteration > last) {
    throw Error(Fault::input, name_of(wish) + " took " + std::to_string(last) +
                                  " iterations, so there is no " + std::to_string(wish.iteration));
  }
}

std::string name_of_frame(int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "%04d.png", frame);
  return name;
}

void write_turntable(Scene& scene, Renderer& renderer, const ViewOptions& options,
                     Session& session) {
  const Monitor monitor = session.monitor();
  make_folder(options.turntable);
  // Fitted to the widest view, so that the shape does not breathe as it turns; with its mirror
  // image, so that the middle of the box is the middle of the picture.
  std::vector<glm::vec3> points = scene.points();
  const glm::vec3 middle = scene.bounds().middle();
  const std::size_t count = points.size();
  for (std::size_t k = 0; k < count; ++k) points.push_back(2.0F * middle - points[k]);
  float distance = 0;
  for (int frame = 0; frame < options.frames; ++frame) {
    const float angle = 2 * std::numbers::pi_v<float> / static_cast<float>(options.frames);
    Camera turned = scene.camera;
    orbit(turned, angle * static_cast<float>(frame), 0);
    fit(turned, points, static_cast<float>(options.width) / static_cast<float>(options.height));
    distance = std::max(distance, turned.distance);
  }
  scene.camera.distance = distance / options.camera.zoom;
  scene.camera.target = middle;
  for (int frame = 0; frame < options.frames; ++frame) {
    monitor.report("turntable", static_cast<double>(frame) / options.frames);
    write_outputs({{(options.turntable / name_of_frame(frame)).string(),
                    screenshot(scene, renderer, options.width, options.height)}},
                  session);
    orbit(scene.camera, 2 * std::numbers::pi_v<float> / static_cast<float>(options.frames), 0);
  }
  warn_of_older_files(options.turntable, name_of_frame(options.frames), session);
}

/// Drawn so many times as wide and high, for smooth edges.
int factor_of(int width, int height) { return 2 * std::max(width, height) <= largest_side ? 2 : 1; }

PixelRows drawn(Scene& scene, Renderer& renderer, int width, int height, const Part& part) {
  const int factor = factor_of(width, height);
  scene.upload(renderer);
  renderer.draw(
      scene.camera, scene.look_now(),
      {width * factor,
       height * factor,
       {},
       scene.bounds(),
       Part{part.x * factor, part.y * factor, part.width * factor, part.height * factor}});
  return shrunk(renderer.read(), factor);
}

/// Sees what the view shows in a picture of this size.
void look_through(Scene& scene, const View& view, int width, int height) {
  Camera& camera = scene.camera;
  glm::mat3 rows(1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rows[row][column] = static_cast<float>(view.axes(row, column));
    }
  }
  look_from(camera, Side::best, rows);
  camera.orthographic = true;
  const Eigen::Vector2d aside = view.centre - Eigen::Vector2d(width, height) / 2;
  const Eigen::Vector3d target =
      view.target + (view.axes.row(1) * aside.y() - view.axes.row(0) * aside.x()).transpose() /
                        view.pixels_per_unit;
  camera.target = shown_point(target.transpose(), scene.document.space);
  camera.distance *=
      shown_length(1 / view.pixels_per_unit, scene.document.space) / camera.unit_per_pixel(height);
}

/// The border between two views of a surface: along x or y, midway between their nearest points.
struct Parting {
  int axis = 0;
  double at = 0;               ///< pixels from the upper left corner
  bool first_is_lower = true;  ///< the first view is on the side of the smaller coordinates
};

Parting parting_of(const std::array<View, 2>& views, const Positions& points) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<Eigen::AlignedBox2d, 2> seen;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (const auto& point : points.rowwise()) {
      seen[view].extend(views[view].project(point).head<2>());
    }
  }
  Parting best;
  double widest = -far;
  for (int axis = 0; axis < 2; ++axis) {
    for (const bool first_is_lower : {true, false}) {
      const auto& lower = seen[first_is_lower ? 0 : 1];
      const auto& upper = seen[first_is_lower ? 1 : 0];
      const double gap = upper.min()[axis] - lower.max()[axis];
      if (gap <= widest) continue;
      widest = gap;
      best = {axis, (upper.min()[axis] + lower.max()[axis]) / 2, first_is_lower};
    }
  }
  return best;
}

/// The part of the picture that each view has.
std::array<Part, 2> parts_of(const Parting& parting, int width, int height) {
  Part lower{0, 0, width, height};
  Part upper = lower;
  const int size = parting.axis == 0 ? width : height;
  const int split = std::clamp(static_cast<int>(std::ceil(parting.at - 0.5)), 0, size);
  if (parting.axis == 0) {
    lower.width = upper.x = split;
    upper.width = width - split;
  } else {  // parts count from below, views from above
    lower.y = upper.height = height - split;
    lower.height = split;
  }
  if (parting.first_is_lower) return {lower, upper};
  return {upper, lower};
}

void put(const PixelRows& rows, const Part& part, PixelRows& whole) {
  const auto row = [](const PixelRows& of, int x, int y) {
    return (static_cast<std::ptrdiff_t>(y) * of.width + x) * 4;
  };
  for (int y = 0; y < rows.height; ++y) {
    std::copy_n(rows.bytes.begin() + row(rows, 0, y), 4 * rows.width,
                whole.bytes.begin() + row(whole, part.x, part.y + y));
  }
}

/// Before hours of work: draws a triangle as large.
void require_picture_of(int width, int height, const Look& look, Renderer& renderer) {
  constexpr int usual_side = 4096;  // which no driver refuses
  if (std::max(width, height) * factor_of(width, height) <= usual_side) return;
  Document triangle;
  triangle.surface.positions = Positions::Identity(3, 3);
  triangle.surface.triangles.resize(1, 3);
  triangle.surface.triangles << 0, 1, 2;
  Scene scene(std::move(triangle));
  scene.look = look;
  try {
    (void)drawn(scene, renderer, width, height, {0, 0, width, height});
  } catch (const Error& error) {
    if (error.fault() != Fault::device) throw;
    const std::string twice =
        factor_of(width, height) == 2 ? ", as it is drawn twice as wide and high" : "";
    throw Error(Fault::device, "--size " + std::to_string(width) + "x" + std::to_string(height) +
                                   ": OpenGL made no picture so large" + twice +
                                   "; make it smaller, every driver draws 2048x2048");
  }
}

}  // namespace

std::string screenshot(Scene& scene, Renderer& renderer, int width, int height) {
  return png_of(drawn(scene, renderer, width, height, {0, 0, width, height}));
}

std::string screenshot_of_two_sides(Scene& scene, Renderer& renderer, int width, int height) {
  const Document& document = scene.document;
  const Surface& surface = document.surface;
  const std::array<View, 2> views =
      best_views(surface, width, height, customary_up(document.format, document.to_gltf));
  const std::array<Part, 2> parts = parts_of(parting_of(views, surface.positions), width, height);
  PixelRows both{width, height, {}};
  both.bytes.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (parts[i].width == 0 || parts[i].height == 0) continue;
    look_through(scene, views[i], width, height);
    put(drawn(scene, renderer, width, height, parts[i]), parts[i], both);
  }
  return png_of(both);
}

void turn_joints(Scene& scene, const std::vector<JointTurn>& wished) {
  if (wished.empty()) return;
  JointTurns turns;
  for (const JointTurn& wish : wished) {
    const auto joint = static_cast<std::size_t>(joint_called(scene, wish.joint));
    turns.resize(scene.rig()->names.size(), Eigen::Quaterniond::Identity());
    turns[joint] = turn_by(wish.degrees) * turns[joint];
  }
  scene.turn(std::move(turns));
}

void place_camera(Scene& scene, const ViewOptions& options) {
  scene.camera.orthographic = !options.perspective;
  look_from(scene.camera, options.camera.side, scene.best_axes());
  orbit(scene.camera, -glm::radians(options.camera.azimuth),
        glm::radians(options.camera.elevation));
  fit(scene.camera, scene.points(),
      static_cast<float>(options.width) / static_cast<float>(options.height));
  scene.camera.distance /= options.camera.zoom;
}

std::string write_pictures(const ViewOptions& options, Session& session) {
  const Monitor monitor = session.monitor();
  const HeadlessContext context;
  Renderer renderer;
  require_picture_of(options.width, options.height, options.look, renderer);
  Scene scene(open_for_pictures(options, monitor));
  scene.look = options.look;
  if (scene.look.surface_colour == ColourBy::file) {
    scene.materials =
        materials_of(scene.document.mesh_file,
                     static_cast<std::size_t>(scene.document.surface.positions.rows()), monitor);
  }
  const bool makes_rig = options.stage.stage == "rig";
  if (!makes_rig) look_at_rig(scene, options.joint);
  if (makes_rig && scene.document.rig) {
    monitor.say("the file has a rig, which is shown without --stage rig; another one is made");
  }
  const bool wants_run = options.run && (!scene.document.rig || options.stage_given);
  if (options.stage.stage == "input") {
    if (scene.document.has_surface()) scene.own_skeleton = nullptr;
  } else if (makes_rig && scene.own_skeleton && scene.document.has_surface()) {
    add_rig_of_file(scene, options.pipeline, monitor);
    go_to(scene, options.stage);
    look_at_rig(scene, options.joint);
  } else if (scene.document.has_surface() && wants_run &&
             (!scene.own_skeleton || options.stage_given)) {
    scene.own_skeleton = nullptr;
    if (makes_rig) {
      add_rig(scene, options.pipeline, monitor);
    } else {
      finish_run(scene, options, monitor);
    }
    go_to(scene, options.stage);
    look_at_rig(scene, options.joint);
  } else if (options.stage_given && !(scene.own_skeleton && options.stage.stage == "skeleton")) {
    if (!options.run) {
      throw UsageError("--no-run makes no stage " + name_of(options.stage) +
                       "; leave out --no-run, or --stage");
    }
    go_to(scene, options.stage);  // says that it never came
  }
  turn_joints(scene, options.turns);
  monitor.report("draw", 0);
  std::string written;
  place_camera(scene, options);
  if (!options.screenshot.empty()) {
    if (options.two_sides && scene.document.surface.triangles.rows() == 0) {
      throw Error(Fault::input, "--two-sides needs a surface, which a skeleton alone has not");
    }
    const auto draw = options.two_sides ? screenshot_of_two_sides : screenshot;
    write_outputs({{options.screenshot, draw(scene, renderer, options.width, options.height)}},
                  session);
    written += "wrote " + options.screenshot + "\n";
  }
  if (!options.turntable.empty()) {
    write_turntable(scene, renderer, options, session);
    written += "wrote " + std::to_string(options.frames) + " pictures to " +
               options.turntable.string() + "\n";
  }
  return written;
}

}  // namespace curveskel::viewer
