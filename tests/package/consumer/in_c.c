/* Says why the law may not drive the arm, or presses it. */
#include <stdio.h>

#include <tissue_in_c.h>
#include <training_arm_device.h>

int main(void) {
  const dashpot_device arm = dashpot_device_training_arm();
  const char *refusal = DASHPOT_REFUSAL(tissue_in_c, &arm);
  tissue_in_c tissue;
  double time, position, velocity;
  tissue_in_c_init(&tissue);
  printf("# %s: %s\n", arm.name, refusal[0] == '\0' ? "certified" : refusal);
  while (scanf("%lf,%lf,%lf", &time, &position, &velocity) == 3) {
    const dashpot_command command = tissue_in_c_step(&tissue, position, velocity);
    printf("%.17g,%.17g\n", command.damping, command.force);
  }
  return 0;
}
