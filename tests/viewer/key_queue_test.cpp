// Laws of keys that come faster than frames.
#include "viewer/window/key_queue.hpp"

#include <gtest/gtest.h>

#include <random>

namespace curveskel::viewer::key_queue_laws {
namespace {

constexpr int ctrl = 1;
constexpr int keys = 6;  // the first two are modifiers

KeyEvent key(int which, bool down) {
  KeyEvent event;
  event.key = which;
  event.down = down;
  event.modifier = which <= ctrl;
  event.ends = which == keys - 1;
  return event;
}

KeyEvent typed(unsigned letter) {
  KeyEvent event;
  event.letter = letter;
  return event;
}

std::vector<std::vector<KeyEvent>> frames_of(const std::vector<KeyEvent>& events) {
  KeyQueue queue;
  for (const KeyEvent& event : events) queue.add(event);
  std::vector<std::vector<KeyEvent>> frames;
  while (!queue.empty()) frames.push_back(queue.take());
  return frames;
}

TEST(KeyQueue, TapIsSeen) {
  const auto frames = frames_of({key(3, true), key(3, false)});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[0].front().down);
  EXPECT_FALSE(frames[1].front().down);
}

TEST(KeyQueue, ShortcutKeepsItsModifier) {
  const auto frames =
      frames_of({key(ctrl, true), key(3, true), key(ctrl, false), key(3, false), key(4, true)});
  ASSERT_GE(frames.size(), 2U);
  EXPECT_EQ(frames[0], (std::vector<KeyEvent>{key(ctrl, true), key(3, true)}));
  EXPECT_EQ(frames[1].front(), key(ctrl, false));
}

TEST(KeyQueue, DifferentKeysShareAFrame) {
  EXPECT_EQ(frames_of({key(2, true), typed('a'), key(3, true), typed('b')}).size(), 1U);
}

TEST(KeyQueue, WhatFollowsTheEndOfADialogueIsNotForTheDialogue) {
  const KeyEvent enter = key(keys - 1, true);
  const auto frames = frames_of({typed('a'), enter, typed('b'), key(4, true)});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0], (std::vector<KeyEvent>{typed('a'), enter}));
}

TEST(KeyQueue, NothingIsLostOrOutOfOrder) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<KeyEvent> events;
    for (unsigned i = 0; i < 40; ++i) {
      if (random() % 4 == 0) {
        events.push_back(typed(100 + i));
      } else {
        events.push_back(key(static_cast<int>(random() % keys), random() % 2 == 0));
      }
    }
    std::vector<KeyEvent> together;
    for (const auto& frame : frames_of(events)) {
      ASSERT_FALSE(frame.empty());
      std::vector<int> changes(keys);
      for (const KeyEvent& event : frame) {
        if (event.letter == 0) {
          EXPECT_EQ(++changes[static_cast<std::size_t>(event.key)], 1);
        }
      }
      together.insert(together.end(), frame.begin(), frame.end());
    }
    EXPECT_EQ(together, events);
  }
}

TEST(KeyQueue, EmptyGivesNothing) { EXPECT_TRUE(KeyQueue().take().empty()); }

TEST(KeyOnLayout, IsTheLetterThatIsWritten) {
  EXPECT_EQ(key_on_layout('Y', "z"), 'Z') << "German";
  EXPECT_EQ(key_on_layout('Q', "a"), 'A') << "French";
  EXPECT_EQ(key_on_layout(';', "m"), 'M') << "French";
  EXPECT_EQ(key_on_layout('M', ","), ',') << "French";
  EXPECT_EQ(key_on_layout('S', "o"), 'O') << "Dvorak";
}

TEST(KeyOnLayout, StaysWhereNoOtherLetterIsWritten) {
  EXPECT_EQ(key_on_layout('1', "&"), '1') << "French";
  EXPECT_EQ(key_on_layout('S', "\xD1\x8B"), 'S') << "Russian";
  EXPECT_EQ(key_on_layout(256, nullptr), 256) << "Escape";
  for (char letter = 'a'; letter <= 'z'; ++letter) {
    const char name[] = {letter, 0};
    EXPECT_EQ(key_on_layout(letter - 'a' + 'A', name), letter - 'a' + 'A');
  }
}

}  // namespace
}  // namespace curveskel::viewer::key_queue_laws
