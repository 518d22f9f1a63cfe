/* read_samples FILE ROWS TYPES: writes what `sampler` collects with all its bits, which halsampler rounds to six decimals. */
#include <hal.h>
#include <rtapi.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLER_KEY 0x48534130 /* of channel 0 */

int main(int count, char **words) {
  const int component = hal_init("read_samples");
  hal_stream_t stream;
  union hal_stream_data row[HAL_STREAM_MAX_PINS];
  sig_atomic_t stop = 0;
  unsigned number = 0;
  FILE *file = count == 4 ? fopen(words[1], "w") : NULL;
  if (component < 0 || file == NULL) return 1;
  hal_ready(component);
  if (hal_stream_attach(&stream, component, SAMPLER_KEY, words[3]) < 0) return 1;
  for (int i = 0; i < atoi(words[2]); ++i) {
    hal_stream_wait_readable(&stream, &stop);
    if (hal_stream_read(&stream, row, &number) < 0) return 1;
    fprintf(file, "%u", number);
    for (size_t pin = 0; pin < strlen(words[3]); ++pin) fprintf(file, " %a", row[pin].f);
    fprintf(file, "\n");
  }
  hal_stream_detach(&stream);
  hal_exit(component);
  return fclose(file) == 0 ? 0 : 1;
}
