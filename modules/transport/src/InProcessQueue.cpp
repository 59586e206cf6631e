#include "lamp/transport/InProcessQueue.h"

namespace lamp {

InProcessQueue::InProcessQueue(size_t capacity) : capacity_(capacity) {}

bool InProcessQueue::send(Message message) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < capacity_ || receiver_closed_; });
  if (receiver_closed_) return false;
  waiting_.push_back(std::move(message));
  changed_.notify_all();
  return true;
}

std::optional<Message> InProcessQueue::receive() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || sender_closed_; });
  if (waiting_.empty()) return std::nullopt;
  Message message = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  return message;
}

void InProcessQueue::closeSender() {
  const std::lock_guard lock(mutex_);
  sender_closed_ = true;
  changed_.notify_all();
}

void InProcessQueue::closeReceiver() {
  const std::lock_guard lock(mutex_);
  receiver_closed_ = true;
  changed_.notify_all();
}

}  // namespace lamp
