#include <tissue_in_c.h>
#include <training_arm_device.h>

double force_in_c(tissue_in_c *tissue, float position, float velocity);
int is_refused(void);

double force_in_c(tissue_in_c *tissue, float position, float velocity) {
  return tissue_in_c_step(tissue, position, velocity).force;
}

int is_refused(void) {
  const dashpot_device arm = dashpot_device_training_arm();
  return DASHPOT_REFUSAL(tissue_in_c, &arm)[0] != '\0';
}
