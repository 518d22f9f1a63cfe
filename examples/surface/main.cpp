// A liver's surface of 80 mm by 50 mm in 4,000 points, into which a ball of 15 mm radius is pressed 5 mm deep. Every
// point is the same network with a state of its own, all are stepped by one call. Ends with 1 if the sum is not the
// closed form.
#include <cmath>
#include <cstdio>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <surface_point_batch.hpp>
#include <probe_device.hpp>

using described = dashpot::devices::probe;

constexpr int columns = 80, rows = 50, points = columns * rows;
constexpr double patch = 1e-3, ball = 15e-3;  // [m]
constexpr double bed = 3 * 1160 / 20e-3;      // [N/m³], of the points' springs when all has relaxed

// A model for the servo loop (dashpot/model.hpp): the tool's depth in, the sum of all points' forces out.
class surface {
 public:
  using scalar = double;
  static constexpr scalar sample_period = dashpot::generated::surface_point_batch::sample_period;
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  struct certified_for {
    static constexpr bool any_device = true;  // nothing is proved of the sum
    static constexpr const char* device = "ideal";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "exact";
    static constexpr unsigned loop_delay = 0;
  };

  surface() : depths_(points), speeds_(points), forces_(points), below_(points) {
    for (int i = 0; i < points; ++i) {
      const double x = (i % columns - (columns - 1) / 2.0) * patch, y = (i / columns - (rows - 1) / 2.0) * patch;
      below_[static_cast<std::size_t>(i)] = (x * x + y * y) / (2 * ball);  // [m], by which the ball is higher there
    }
  }

  void reset(scalar) noexcept { tissue_.reset(); }

  dashpot::command<scalar> output(scalar depth, scalar velocity) noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < points; ++i) {
      depths_[i] = depth > below_[i] ? depth - below_[i] : 0;
      speeds_[i] = depth > below_[i] ? velocity : 0;
    }
    tissue_.output(depths_.data(), speeds_.data(), forces_.data());
    for (const double force : forces_) sum += force > 0 ? force : 0;  // the ball does not stick
    return {0, sum};
  }

  void update() noexcept { tissue_.update(depths_.data(), speeds_.data()); }

  scalar stored_energy() const noexcept {
    double sum = 0;
    for (int i = 0; i < points; ++i) sum += tissue_.stored_energy(i);
    return sum;
  }

  double force_at(int i) const noexcept { return forces_[static_cast<std::size_t>(i)]; }  // [N]

 private:
  dashpot::generated::surface_point_points<points> tissue_;
  std::vector<double> depths_, speeds_, forces_, below_;  // made once: the servo thread asks for no memory
};

int main(int, char** arguments) {
  static surface liver;
  const dashpot::device_description facts = described::description();
  dashpot::simulated::scenario scene;
  scene.prescribed = true;
  scene.intended = dashpot::simulated::smoothly_through({{0, 0}, {0.5, 5e-3}});
  dashpot::simulated_device device(facts, scene);
  dashpot::any_estimator<double> estimator(facts.velocity, facts.loop.sample_period, facts.encoder.step);
  std::vector<dashpot::telemetry_record> felt;
  dashpot::servo_options options;
  options.identity = {described::name, described::digest};
  options.duration = 0.7;  // [s]
  options.outputs.observe = [&](const dashpot::telemetry_record& record) { felt.push_back(record); };
  const auto run = dashpot::servo_loop(liver, device, estimator, options, dashpot::simulated_clock{}).run();

  // A paraboloid in such a bed, at rest: F = π R c d². A circle of 12 mm is covered by squares of 1 mm, which is off by
  // less than a hundredth.
  const dashpot::telemetry_record& last = felt.at(felt.size() - 1);
  const double depth = last.position, force = last.motor_force;
  const double closed_form = 3.141592653589793 * ball * bed * depth * depth;
  std::printf("%d points, %.3f mm deep: %.4f N, a bed without grain %.4f N\n", points, depth * 1e3, force, closed_form);
  if (std::FILE* table = arguments[1] ? std::fopen(arguments[1], "w") : nullptr) {
    std::fputs("curve,from the middle [mm],force of a point [mN]\n", table);
    for (int row : {25, 30, 35}) {
      for (int column = 0; column < columns; ++column) {
        std::fprintf(table, "%d mm beside it,%.1f,%.4f\n", row - 25, (column - (columns - 1) / 2.0) * patch * 1e3,
                     liver.force_at(row * columns + column) * 1e3);
      }
    }
    std::fclose(table);
  }
  return run.left_safe && run.faults.total() == 0 && std::fabs(force / closed_form - 1) < 0.01 ? 0 : 1;
}
