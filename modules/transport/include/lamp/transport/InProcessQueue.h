#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>

#include "lamp/transport/Transport.h"

namespace lamp {

/** Bounded queue between a front-end thread and the base station of one process. Order is kept, so
 * the map does not depend on which side is faster. */
class InProcessQueue : public MessageSender, public MessageReceiver {
 public:
  /** \param capacity messages that may wait; the sender blocks beyond, which bounds memory. */
  explicit InProcessQueue(size_t capacity);

  bool send(Message message) override;
  std::optional<Message> receive() override;
  /** The sender is done; what waits is still received. */
  void closeSender();
  /** The receiver is gone: a blocked sender wakes, further messages are refused. */
  void closeReceiver();

 private:
  const size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Message> waiting_;
  bool sender_closed_ = false;
  bool receiver_closed_ = false;
};

}  // namespace lamp
