#include "grid/halo_channel.h"

#include <vector>

namespace mesoslip
{
namespace
{
class MessageChannel : public HaloChannel
{
public:
  MessageChannel(MPI_Comm communicator,
                 const int neighbour,
                 const Halo::Side side,
                 const std::size_t capacity)
    : communicator(communicator)
    , neighbour(neighbour)
    , send_tag(side == Halo::upper ? upward_tag : downward_tag)
    , receive_tag(side == Halo::upper ? downward_tag : upward_tag)
    , out(capacity)
    , in(capacity)
  {
  }

  /** Every message sent has been received when all ranks have done their last step. */
  ~MessageChannel() override
  {
    if (receiving != MPI_REQUEST_NULL)
      {
        MPI_Cancel(&receiving);
        MPI_Wait(&receiving, MPI_STATUS_IGNORE);
      }
    MPI_Wait(&sending, MPI_STATUS_IGNORE);
  }

  double *room() override
  {
    MPI_Wait(&sending, MPI_STATUS_IGNORE);
    return out.data();
  }

  /** A message out announces one in: the neighbour runs the same number of steps. */
  void send(const std::size_t n) override
  {
    MPI_Isend(out.data(), static_cast<int>(n), MPI_DOUBLE, neighbour, send_tag,
              communicator, &sending);
    post();
  }

  const double *receive() override
  {
    post();
    MPI_Wait(&receiving, MPI_STATUS_IGNORE);
    return in.data();
  }

  void progress() override
  {
    int done = 0;
    MPI_Test(&sending, &done, MPI_STATUS_IGNORE);
  }

private:
  static constexpr int upward_tag = 71, downward_tag = 72;

  void post()
  {
    if (receiving == MPI_REQUEST_NULL)
      MPI_Irecv(in.data(), static_cast<int>(in.size()), MPI_DOUBLE, neighbour,
                receive_tag, communicator, &receiving);
  }

  MPI_Comm communicator;
  const int neighbour, send_tag, receive_tag;
  std::vector<double> out, in;
  MPI_Request sending   = MPI_REQUEST_NULL;
  MPI_Request receiving = MPI_REQUEST_NULL;
};
} // namespace

std::unique_ptr<HaloChannel> make_message_channel(MPI_Comm communicator,
                                                  const int neighbour,
                                                  const Halo::Side side,
                                                  const std::size_t capacity)
{
  return std::make_unique<MessageChannel>(communicator, neighbour, side, capacity);
}
} // namespace mesoslip
