// fig5 FOLDER: the paper's Fig. 5 by emitted code. Prints and writes FOLDER/fig5.csv and FOLDER/fig5.svg: the 2nd-order
// Maxwell solid through a ramp and a hold in steps of 200 ms; then takes a published tissue through the same motion.
// Exit status 1 if a law emitted with the scheme `exact` is not the closed form, or if the paper's scheme errs
// otherwise than it is known to.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include <heel_fat_pad.hpp>
#include <second_order_maxwell.hpp>
#include <second_order_maxwell_euler.hpp>

#include "fig5_figure.hpp"
#include "ramp_and_hold.hpp"
#include "response.hpp"

namespace {

using namespace dashpot::paper;
using namespace dashpot::paper::fig5;
using dashpot::generated::heel_fat_pad;
using dashpot::generated::second_order_maxwell;
using dashpot::generated::second_order_maxwell_euler;

constexpr double rounding = 1e-12;  // of the peak: some hundreds of operations on doubles

// B1 to B3 and K1 to K3 of networks/tissues/heel_fat_pad.json, and K0.
const MaxwellSolid heel{{{0.3612, 361.2}, {46.354, 4635.4}, {1204, 120.4}}, 903};

using Samples = std::vector<ResponseSample>;

std::string csv(const Samples& exact, const Samples& euler) {
  std::string text =
      "time [s],position [m],closed form [N],exact [N],brake [N],motor [N],error [N],"
      "backward Euler [N],error of backward Euler [N]\n";
  for (std::size_t i = 0; i < exact.size(); ++i)
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", exact[i].time, exact[i].position, exact[i].closed_form,
                        exact[i].emitted(), exact[i].brake, exact[i].motor, exact[i].error(), euler[i].emitted(),
                        euler[i].error());
  return text;
}

void print_rows(const Samples& samples, std::size_t every) {
  fmt::print("{:>8} {:>10} {:>12} {:>12} {:>10} {:>10} {:>10}\n", "time", "position", "closed form", "emitted", "brake",
             "motor", "error");
  fmt::print("{:>8} {:>10} {:>12} {:>12} {:>10} {:>10} {:>10}\n", "s", "mm", "N", "N", "N", "N", "N");
  for (std::size_t i = 0; i < samples.size(); i += every)
    fmt::print("{:8.1f} {:10.3f} {:12.8f} {:12.8f} {:10.6f} {:10.6f} {:10.1e}\n", samples[i].time,
               samples[i].position * 1e3, samples[i].closed_form, samples[i].emitted(), samples[i].brake,
               samples[i].motor, samples[i].error());
}

// True if `samples` are the closed form but for rounding; prints by how much.
bool is_closed_form(const Samples& samples) {
  fmt::print("scheme exact: largest error {:.1e} of the peak, {:.6f} N\n", relative_error(samples), peak(samples));
  return relative_error(samples) <= rounding;
}

bool errs_as_known(const Samples& euler) {
  fmt::print("scheme backward-euler, the paper's: largest error {:.3f} % of the peak, at {} s\n",
             100 * relative_error(euler), worst(euler).time);
  return std::abs(relative_error(euler) - euler_error) <= euler_error_digits && worst(euler).time == euler_error_time;
}

bool run_solid(const std::filesystem::path& folder) {
  const Samples exact = respond<second_order_maxwell>(solid, insertion, end);
  const Samples euler = respond<second_order_maxwell_euler>(solid, insertion, end);
  fmt::print(
      "\nFig. 5: K1 = 12, K2 = 10, K3 = 5 N/m, B1 = 5, B2 = 6 N s/m; {} mm/s for {} s, then held; every {} s\n\n",
      insertion.rate * 1e3, insertion.ramp_time, second_order_maxwell::sample_period);
  print_rows(exact, 2);
  const bool exact_agrees = is_closed_form(exact), euler_agrees = errs_as_known(euler);
  std::ofstream(folder / "fig5.csv") << csv(exact, euler);
  std::ofstream(folder / "fig5.svg") << to_svg(figure(exact, euler, second_order_maxwell{}.output(0, 0).damping));
  return exact_agrees && euler_agrees;
}

bool run_heel() {
  constexpr RampAndHold step_on_it{1e-3, 4};
  const Samples samples = respond<heel_fat_pad>(heel, step_on_it, end);
  fmt::print("\nHuman heel fat pad, {} mm/s for {} s, then held; every {} s\n\n", step_on_it.rate * 1e3,
             step_on_it.ramp_time, heel_fat_pad::sample_period);
  print_rows(samples, samples.size() / 8);
  return is_closed_form(samples);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: fig5 FOLDER\n");
    return 2;
  }
  const bool solid_agrees = run_solid(arguments[1]);
  const bool heel_agrees = run_heel();
  return solid_agrees && heel_agrees ? 0 : 1;
}
