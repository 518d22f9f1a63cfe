#if ring
typedef struct law_type {
  double positions[SIZE];  // the last ones, in a ring [m] or [rad]
  unsigned newest;
} law_type;

// At rest at `position` [m] or [rad].
static inline void law_reset(law_type *self, double position) {
  for (unsigned i = 0u; i < SIZE; ++i) self->positions[i] = position;
  self->newest = 0u;
}

static inline void law_push(law_type *self, double position) {
  self->newest = (self->newest + 1u) & LAST;
  self->positions[self->newest] = position;
}

// The position `age` samples ago.
static inline double law_position(const law_type *self, unsigned age) {
  return self->positions[(self->newest - age) & LAST];
}

#endif
#if slope
// N Σ y(k−i) − 2 Σ i y(k−i) over i = 0 … N, N being the window, in pairs: exactly 0 at rest.
static inline double law_slope_sum(const law_type *self, unsigned window) {
  double sum = 0.0;
  for (unsigned i = 0u; (2u * i) < window; ++i)
    sum += (double)(window - (2u * i)) * (law_position(self, i) - law_position(self, window - i));
  return sum;
}

#endif
#if backward_difference
// The difference of two positions. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  law_push(self, position);
  return (position - law_position(self, WINDOW)) * RATE;
}
#elif least_squares
// The slope of a line through the last positions. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  law_push(self, position);
  return law_slope_sum(self, WINDOW) * RATE;
}
#elif foaw
// The slopes, per sample, that a set of bounds leaves: fractions, so that no division is rounded.
typedef struct law_slopes {
  int is_bounded;
  double low, low_span, high, high_span;  // [m] or [rad] over [samples]
} law_slopes;

// Leaves slopes s with |difference − s span| within the band of an encoder step.
static inline void law_narrow(law_slopes *slopes, double difference, double span) {
  const double low = difference - BAND, high = difference + BAND;
  if ((slopes->is_bounded == 0) || ((low * slopes->low_span) > (slopes->low * span))) {
    slopes->low = low;
    slopes->low_span = span;
  }
  if ((slopes->is_bounded == 0) || ((high * slopes->high_span) < (slopes->high * span))) {
    slopes->high = high;
    slopes->high_span = span;
  }
  slopes->is_bounded = 1;
}

#if best_fit
// The longest window whose samples all lie within half a count of some line.
static inline unsigned law_window(const law_type *self) {
  law_slopes slopes = {0, 0.0, 1.0, 0.0, 1.0};
  for (unsigned n = 1u; n <= WINDOW; ++n) {
    for (unsigned i = 0u; i < n; ++i)
      law_narrow(&slopes, law_position(self, i) - law_position(self, n), (double)(n - i));
    if ((slopes.low * slopes.high_span) > (slopes.high * slopes.low_span)) return n - 1u;
  }
  return WINDOW;
}

// The slope of a line through a window as long as the motion is steady. Finite position [m] or [rad] → velocity [m/s]
// or [rad/s].
static inline double law_update(law_type *self, double position) {
  law_push(self, position);
  const unsigned window = law_window(self);
  const double n = (double)window;
  return 6.0 * law_slope_sum(self, window) / (n * (n + 1.0) * (n + 2.0) * PERIOD);
}
#endif
#if end_fit
// The longest window whose inner samples all lie within a count of the line through its ends.
static inline unsigned law_window(const law_type *self) {
  law_slopes slopes = {0, 0.0, 1.0, 0.0, 1.0};
  for (unsigned n = 1u; n <= WINDOW; ++n) {
    const double difference = law_position(self, 0u) - law_position(self, n), span = (double)n;
    if ((slopes.is_bounded != 0) && (!((slopes.low * span) <= (difference * slopes.low_span)) ||
                                     !((difference * slopes.high_span) <= (slopes.high * span))))
      return n - 1u;
    law_narrow(&slopes, difference, span);
  }
  return WINDOW;
}

// The difference over a window as long as the motion is steady. Finite position [m] or [rad] → velocity [m/s] or
// [rad/s].
static inline double law_update(law_type *self, double position) {
  law_push(self, position);
  const unsigned window = law_window(self);
  return (law_position(self, 0u) - law_position(self, window)) / ((double)window * PERIOD);
}
#endif
#elif butterworth
typedef struct law_type {
  double previous_position;              // [m] or [rad]
  double band[SECTIONS], low[SECTIONS];  // [m/s] or [rad/s]
} law_type;

// At rest at `position` [m] or [rad].
static inline void law_reset(law_type *self, double position) {
  self->previous_position = position;
  for (int i = 0; i < SECTIONS; ++i) self->band[i] = self->low[i] = 0.0;
}

// The one-sample difference through a Butterworth low-pass. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  static const double damped[SECTIONS] = {DAMPED}, solve[SECTIONS] = {SOLVE};
  double velocity = (position - self->previous_position) * RATE;
  self->previous_position = position;
  for (int i = 0; i < SECTIONS; ++i) {
    const double high = (velocity - damped[i] * self->band[i] - self->low[i]) * solve[i];
    const double band = self->band[i] + HALF_STEP * high;
    const double low = self->low[i] + HALF_STEP * band;
    self->band[i] = dashpot_flush_below(SMALLEST, band + HALF_STEP * high);
    self->low[i] = dashpot_flush_below(SMALLEST, low + HALF_STEP * band);
    velocity = low;
  }
  return velocity;
}
#elif kalman
typedef struct law_type {
  double previous_position, innovation;  // [m] or [rad]
  double velocity;                       // [m/s] or [rad/s]
} law_type;

// At rest at `position` [m] or [rad].
static inline void law_reset(law_type *self, double position) {
  self->previous_position = position;
  self->innovation = self->velocity = 0.0;
}

// Constant-velocity Kalman filter in its steady state. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  const double innovation =
      (position - self->previous_position) + POSITION_LEAK * self->innovation - PERIOD * self->velocity;
  self->previous_position = position;
  self->innovation = dashpot_flush_below(SMALLEST, innovation);
  self->velocity = dashpot_flush_below(SMALLEST, self->velocity + VELOCITY_GAIN * self->innovation);
  return self->velocity;
}
#elif super_twisting
typedef struct law_type {
  double previous_position, error;  // [m] or [rad]
  double drift;                     // [m/s] or [rad/s]
} law_type;

// At rest at `position` [m] or [rad].
static inline void law_reset(law_type *self, double position) {
  self->previous_position = position;
  self->error = self->drift = 0.0;
}

// Levant's differentiator, stepped by implicit Euler. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  const double lead = self->error - (position - self->previous_position);
  self->previous_position = position;
  const double target = lead + PERIOD * self->drift;
  const double excess = ((target < 0.0) ? -target : target) - PERIOD * PERIOD * SWITCHING;
  if (!(excess > 0.0)) {
    self->error = 0.0;
    self->drift = -lead * RATE;
    return self->drift;
  }
  const double side = (target < 0.0) ? -1.0 : 1.0;
  const double pull = PERIOD * ROOT_GAIN;
  const double root = 2.0 * excess / (pull + law_square_root(pull * pull + 4.0 * excess));
  self->error = side * root * root;
  self->drift -= side * PERIOD * SWITCHING;
  return self->drift - side * ROOT_GAIN * root;
}
#elif tracking_differentiator
typedef struct law_type {
  double previous_position, error;  // [m] or [rad]
  double velocity;                  // [m/s] or [rad/s]
} law_type;

// At rest at `position` [m] or [rad].
static inline void law_reset(law_type *self, double position) {
  self->previous_position = position;
  self->error = self->velocity = 0.0;
}

// The share, between −1 and 1, of the acceleration that brings `error` to rest.
static inline double law_synthesis(const law_type *self, double error) {
  const double span = ACCELERATION * HORIZON;
  const double ahead = error + HORIZON * self->velocity, distance = (ahead < 0.0) ? -ahead : ahead;
  const double side = (ahead > 0.0) ? 1.0 : ((ahead < 0.0) ? -1.0 : 0.0);
  const double approach =
      (distance <= (span * HORIZON))
          ? ahead / HORIZON
          : 0.5 * (law_square_root(span * span + 8.0 * ACCELERATION * distance) - span) * side;
  const double share = (self->velocity + approach) / span;
  return (share > 1.0) ? 1.0 : ((share < -1.0) ? -1.0 : share);
}

// Han's tracking differentiator. Finite position [m] or [rad] → velocity [m/s] or [rad/s].
static inline double law_update(law_type *self, double position) {
  const double error = self->error - (position - self->previous_position);
  self->previous_position = position;
  self->error = dashpot_flush_below(SMALLEST, error + PERIOD * self->velocity);
  self->velocity =
      dashpot_flush_below(SMALLEST, self->velocity - PERIOD * ACCELERATION * law_synthesis(self, error));
  return self->velocity;
}
#elif inverse_time
typedef struct law_type {
  unsigned long long edge_time_ns;  // of the newest encoder edge, on the device's clock
  double edge_position;             // [m] or [rad]
  double velocity;                  // [m/s] or [rad/s]
  int has_edge;
} law_type;

// At rest at `position` [m] or [rad]; the edge before the next sample is taken as the first one.
static inline void law_reset(law_type *self, double position) {
  self->edge_time_ns = 0u;
  self->edge_position = position;
  self->velocity = 0.0;
  self->has_edge = 0;
}

// Also where the clock has wrapped around in between.
static inline int law_is_after(unsigned long long time_ns, unsigned long long other_ns) {
  const unsigned long long ahead = time_ns - other_ns;
  return ((ahead > 0u) && (ahead <= 0x7fffffffffffffffull)) ? 1 : 0;
}

static inline double law_seconds(unsigned long long nanoseconds) { return (double)nanoseconds * 1e-9; }

// Counts over the time between encoder edges. Finite position [m] or [rad], the device's clock at the newest edge (0:
// not measured, the sample's own time stands in) and at the sample [ns] → velocity [m/s] or [rad/s]. An edge time that
// runs backwards is no new edge.
static inline double law_update(law_type *self, double position, unsigned long long edge_time_ns,
                                unsigned long long timestamp_ns) {
  const int is_there = (self->has_edge != 0) && (position <= self->edge_position) && (position >= self->edge_position);
  const unsigned long long newest_ns =
      (edge_time_ns != 0u) ? edge_time_ns : (is_there ? self->edge_time_ns : timestamp_ns);
  if ((self->has_edge == 0) || (law_is_after(newest_ns, self->edge_time_ns) != 0)) {
    if (self->has_edge != 0)
      self->velocity = (position - self->edge_position) / law_seconds(newest_ns - self->edge_time_ns);
    self->edge_position = position;
    self->edge_time_ns = newest_ns;
    self->has_edge = 1;
  } else if (law_is_after(timestamp_ns, self->edge_time_ns) != 0) {
    const double fastest = STEP / law_seconds(timestamp_ns - self->edge_time_ns);
    self->velocity =
        (self->velocity > fastest) ? fastest : ((self->velocity < -fastest) ? -fastest : self->velocity);
  }
  return self->velocity;
}
#elif sensor
typedef struct law_type {
  double velocity;  // as measured [m/s] or [rad/s]
} law_type;

static inline void law_reset(law_type *self, double position) {
  (void)position;
  self->velocity = 0.0;
}

// The device measures its velocity: measured velocity → velocity, as it is [m/s] or [rad/s].
static inline double law_update(law_type *self, double velocity) {
  self->velocity = velocity;
  return velocity;
}
#else
// This estimator is not written in C. Write it after <dashpot/estimators/>, or build the loop in C++, or let the device
// file name another estimator and compile the law again: a law is certified with the estimator that its file names.
#endif
