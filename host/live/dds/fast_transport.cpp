#include "host/live/dds/fast_transport.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <utility>

#include "host/live/dds/rtps_check.hpp"

namespace astro::dds {
namespace {

namespace transport = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t kParticipants = 32;  // of one computer, that are looked for without multicast

struct GatedDescriptor : transport::ChainingTransportDescriptor {
  GatedDescriptor(std::shared_ptr<transport::TransportDescriptorInterface> udp, bool alone,
                  std::shared_ptr<const Gate> its_gate, std::shared_ptr<AcknowledgedBy> by)
      : ChainingTransportDescriptor(std::move(udp)),
        here_alone(alone),
        gate(std::move(its_gate)),
        acknowledged(std::move(by)) {}

  transport::TransportInterface* create_transport() const override;

  bool here_alone;
  std::shared_ptr<const Gate> gate;
  std::shared_ptr<AcknowledgedBy> acknowledged;
};

class GatedTransport : public transport::ChainingTransport {
 public:
  explicit GatedTransport(const GatedDescriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  transport::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool send(rtps::SenderResource* sender, const rtps::octet* bytes, std::uint32_t size,
            rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& until) override {
    return !descriptor_.gate->is_open() || sender->send(bytes, size, begin, end, until);
  }
  void receive(transport::TransportReceiverInterface* receiver, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& here, const rtps::Locator_t& there) override {
    if (!descriptor_.gate->is_open() || !may_talk_to(there)) return;
    const ByteView sound = sound_part({bytes, size});
    if (sound.empty()) return;
    const auto changed = for_fast_dds(sound, counts_);
    const ByteView read = changed ? ByteView(*changed) : sound;
    receiver->OnDataReceived(read.data(), static_cast<std::uint32_t>(read.size()), here, there);
    // This comes last, so that Fast DDS has answered the acknowledgement before anybody writes because of it.
    for (const Acknowledgement& each : acknowledgements_in(sound)) descriptor_.acknowledged->note(each);
  }
  bool is_locator_allowed(const rtps::Locator_t& locator) const override {
    return may_talk_to(locator) && ChainingTransport::is_locator_allowed(locator);
  }
  bool transform_remote_locator(const rtps::Locator_t& there, rtps::Locator_t& result) const override {
    // While the gate is shut, all addresses come from our own settings. One of them is the multicast group of the
    // announcements.
    const bool is_refused = descriptor_.gate->is_open() && rtps::IPLocator::isMulticast(there);
    return !is_refused && may_talk_to(there) && ChainingTransport::transform_remote_locator(there, result);
  }
  /// Anybody can announce an address of another kind, for which Fast DDS 2.9 would abort here.
  bool is_local_locator(const rtps::Locator_t& locator) const override {
    return IsLocatorSupported(locator) && ChainingTransport::is_local_locator(locator);
  }

 private:
  bool may_talk_to(const rtps::Locator_t& there) const {
    return !descriptor_.here_alone || is_local_locator(there);
  }

  GatedDescriptor descriptor_;
  AcknowledgementCounts counts_;
};

transport::TransportInterface* GatedDescriptor::create_transport() const { return new GatedTransport(*this); }

}  // namespace

std::shared_ptr<transport::TransportDescriptorInterface> gated_udp(
    bool here_alone, std::shared_ptr<const Gate> gate, std::shared_ptr<AcknowledgedBy> acknowledged) {
  auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = kParticipants;
  return std::make_shared<GatedDescriptor>(std::move(udp), here_alone, std::move(gate),
                                           std::move(acknowledged));
}

}  // namespace astro::dds
