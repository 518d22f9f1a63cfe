#include "report/law_run.hpp"

#include "law/evaluate.hpp"

namespace dashpot::compiler {
namespace {

template <class Scalar>
LawRun run(const UpdateLaw& law, std::size_t count, const std::function<double(double)>& position,
           const std::function<double(double)>& velocity) {
  Evaluation<Scalar> evaluation(law);
  evaluation.reset(0);
  LawRun result;
  for (std::size_t k = 0; k <= count; ++k) {
    const double t = double(k) * law.sample_period;
    const Scalar u = static_cast<Scalar>(position(t)), v = static_cast<Scalar>(velocity(t));
    const command<Scalar> now = evaluation.step(u, v);
    result.time.push_back(t);
    result.position.push_back(double(u));
    result.velocity.push_back(double(v));
    result.brake.push_back(double(now.damping * v));
    result.motor.push_back(double(now.force));
  }
  return result;
}

}  // namespace

LawRun run_law(const UpdateLaw& law, std::size_t count, const std::function<double(double)>& position,
               const std::function<double(double)>& velocity) {
  return law.scalar == ScalarType::float32 ? run<float>(law, count, position, velocity)
                                           : run<double>(law, count, position, velocity);
}

}  // namespace dashpot::compiler
