#include "fake_card.hpp"

#include <cerrno>
#include <string>

namespace dashpot::tests {

fake_card& card() {
  static fake_card the_card;
  return the_card;
}

namespace {

std::string number(unsigned value) { return std::to_string(value); }

// True where the instruction is carried out.
bool carry_out(comedi_insn& one, std::string& told) {
  fake_card& fake = card();
  if (fake.failing_subdevice == one.subdev) {
    errno = fake.failure;
    return false;
  }
  const unsigned channel = CR_CHAN(one.chanspec);
  if (one.insn == INSN_READ && one.subdev == 2) {
    *one.data = fake.counts;
    told += " read 2/" + number(channel);
    return true;
  }
  if (one.insn == INSN_WRITE && one.subdev == 1 && channel < 2 && *one.data <= fake.most_output) {
    fake.outputs[channel] = *one.data;
    told += " write 1/" + number(channel) + "=" + number(*one.data);
    return true;
  }
  errno = EINVAL;
  return false;
}

}  // namespace
}  // namespace dashpot::tests

using dashpot::tests::card;
using dashpot::tests::number;

extern "C" {

comedi_t* comedi_open(const char* file) {
  card().calls.push_back(std::string("open ") + file);
  return card().is_there ? reinterpret_cast<comedi_t*>(&card()) : nullptr;
}

int comedi_close(comedi_t*) {
  card().calls.push_back("close");
  return 0;
}

int comedi_errno() { return ENOENT; }
const char* comedi_strerror(int) { return "No such file or directory"; }

int comedi_get_subdevice_type(comedi_t*, unsigned subdevice) {
  return subdevice == 0   ? COMEDI_SUBD_AI
         : subdevice == 1 ? COMEDI_SUBD_AO
         : subdevice == 2 ? COMEDI_SUBD_COUNTER
                          : COMEDI_SUBD_UNUSED;
}

lsampl_t comedi_get_maxdata(comedi_t*, unsigned subdevice, unsigned) {
  return subdevice == 2 ? card().most_counts : card().most_output;
}

comedi_range* comedi_get_range(comedi_t*, unsigned subdevice, unsigned channel, unsigned range) {
  return subdevice == 1 && channel < 2 && range == 0 ? &card().output_range : nullptr;
}

int comedi_reset_channel(comedi_t*, unsigned subdevice, unsigned channel) {
  card().calls.push_back("reset " + number(subdevice) + "/" + number(channel));
  return 0;
}

int comedi_set_counter_mode(comedi_t*, unsigned subdevice, unsigned channel, unsigned mode) {
  card().calls.push_back("mode " + number(subdevice) + "/" + number(channel) + "=" + number(mode));
  return card().refuses_mode ? -1 : 0;
}

int comedi_arm_channel(comedi_t*, unsigned subdevice, unsigned channel, unsigned) {
  card().calls.push_back("arm " + number(subdevice) + "/" + number(channel));
  return 0;
}

int comedi_do_insnlist(comedi_t*, comedi_insnlist* list) {
  std::string told = "list:";
  int done = 0;
  for (unsigned i = 0; i < list->n_insns; ++i, ++done)
    if (!dashpot::tests::carry_out(list->insns[i], told)) {
      card().calls.push_back(told + " failed");
      return done == 0 ? -1 : done;
    }
  card().calls.push_back(told);
  return done;
}
}
