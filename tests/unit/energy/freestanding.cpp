// Everything that the loop needs of actuation and energy, compiled as firmware would: without a standard library,
// exceptions or run-time types. Nothing in here may need a symbol from elsewhere.
#include <dashpot/actuator.hpp>
#include <dashpot/energy/brake_controller.hpp>
#include <dashpot/energy/hold_observer.hpp>
#include <dashpot/energy/motor_controller.hpp>
#include <dashpot/energy/power_observer.hpp>

namespace dashpot {

template class actuator<float>;
template class actuator<double>;
template class brake_controller<float>;
template class brake_controller<double>;
template class hold_observer<float>;
template class hold_observer<double>;
template class motor_controller<float>;
template class motor_controller<double>;
template class power_observer<float>;
template class power_observer<double>;

}  // namespace dashpot
