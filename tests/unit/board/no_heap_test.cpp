#include <dashpot/board/board_device.hpp>

#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "in_process_board.hpp"
#include "stream_pair.hpp"

namespace {

// Volatile: a compiler may assume that an allocation function changes no variable of the program.
thread_local volatile bool watched = false;
thread_local volatile unsigned allocations = 0;

void note() noexcept {
  if (watched) allocations = allocations + 1;
}

}  // namespace

// The linker sends every call from our objects here (-Wl,--wrap).
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* block, std::size_t size);
void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size);
void* __wrap_realloc(void* block, std::size_t size);

void* __wrap_malloc(std::size_t size) { return note(), __real_malloc(size); }
void* __wrap_calloc(std::size_t count, std::size_t size) { return note(), __real_calloc(count, size); }
void* __wrap_realloc(void* block, std::size_t size) { return note(), __real_realloc(block, size); }
}

void* operator new(std::size_t size) {
  if (void* block = std::malloc(size)) return block;
  throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace dashpot {
namespace {

using namespace board;

template <class Body>
unsigned allocations_in(Body&& body) {
  allocations = 0;
  watched = true;
  body();
  watched = false;
  return allocations;
}

// A trap that catches nothing would let the next test pass whatever the driver does.
TEST(NoHeap, TheTrapWorks) {
  int* volatile kept = nullptr;  // volatile: a compiler may leave out an allocation that nobody sees
  EXPECT_EQ(allocations_in([&] { kept = new int(1); }), 1U);
  delete kept;
}

template <class Plant>
void expect_no_allocation() {
  stream_pair ends = connected_pair();
  in_process_board<no_model, Plant> board(std::move(ends.far));
  board_options patient;
  patient.late_limit = 1e6;  // the board's clock stands still
  basic_board_device<Plant::axes> device(std::move(ends.near), described_board_with<Plant>(), patient);
  std::string error;
  ASSERT_TRUE(board.while_serving([&] { return device.start(error); })) << error;
  typename loop_types<Plant::axes>::sample sample;
  int samples = 0;
  const unsigned allocated = allocations_in([&] {
    for (int i = 0; i < 1000; ++i) {
      device.write({});
      board.serve();
      samples += device.read(sample) == device_status::ok;
      device.ask_statistics();
      device.reset();
    }
  });
  EXPECT_EQ(allocated, 0U);
  EXPECT_GT(samples, 900);
}

// One allocation in the loop is a missed deadline sooner or later.
TEST(NoHeap, ReadingAndWritingAllocateNothing) {
  expect_no_allocation<test_plant>();
  expect_no_allocation<test_arm>();
}

}  // namespace
}  // namespace dashpot
