// The same arm in Pinocchio: its articulated-body algorithm, and one step of Newmark (1/4, 1/2) about it, measured.
#include <Eigen/Core>
#include <ctime>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody.hpp>

namespace {

using Vector = Eigen::VectorXd;
using Given = Eigen::Map<const Vector>;

pinocchio::Model made(int n, const double *length, const double *mass, const double *moment, const double *inertia,
    double gravity)
{
    pinocchio::Model model;
    model.gravity.linear() = Eigen::Vector3d(0.0, -gravity, 0.0);
    pinocchio::JointIndex parent = 0;
    for (int j = 0; j < n; ++j) {
        const Eigen::Vector3d place(j ? length[j - 1] : 0.0, 0.0, 0.0);
        parent = model.addJoint(parent, pinocchio::JointModelRZ(),
            pinocchio::SE3(Eigen::Matrix3d::Identity(), place), "joint" + std::to_string(j));
        const Eigen::Vector3d center(moment[j] / mass[j], 0.0, 0.0);
        const double own = inertia[j] - moment[j] * center[0];
        const pinocchio::Symmetric3 about(0.0, 0.0, own, 0.0, 0.0, own); // of a thin rod; the turn about z counts
        model.appendBodyToJoint(parent, pinocchio::Inertia(mass[j], center, about), pinocchio::SE3::Identity());
    }
    return model;
}

} // namespace

// `x` holds angles, rates and accelerations of the joints, and is what they are after so many steps; with none, the
// accelerations are those of the start. `joint` holds stiffness, damping, slack angle and rotor of each.
extern "C" double peer_seconds(int n, const double *body, double gravity, const double *joint, const double *torque,
    double step, int in_world, double *x, long steps)
{
    pinocchio::Model model = made(n, body, body + n, body + 2 * n, body + 3 * n, gravity);
    const Given stiffness(joint, n), damping(joint + n, n), slack(joint + 2 * n, n), rotors(joint + 3 * n, n);
    const Given given(torque, n);
    const auto frame = in_world ? pinocchio::Convention::WORLD : pinocchio::Convention::LOCAL;
    Eigen::Map<Vector> angle(x, n), rate(x + n, n), last(x + 2 * n, n);
    if (steps == 0) {
        model.armature = rotors;
        pinocchio::Data data(model);
        const Vector exerted = given - stiffness.cwiseProduct(angle - slack) - damping.cwiseProduct(rate);
        last = pinocchio::aba(model, data, angle, rate, exerted, frame);
        return 0.0;
    }
    const double h = step, half = 0.5 * step, quarter = 0.25 * step * step;
    model.armature = rotors + half * damping + quarter * stiffness;
    pinocchio::Data data(model);
    Vector exerted(n), ahead(n), rate_ahead(n), without(n), rate_without(n);
    timespec begin, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (long k = 0; k < steps; ++k) {
        rate_ahead = rate + h * last;
        ahead = angle + h * (rate + half * last);
        without = ahead - quarter * last;
        rate_without = rate_ahead - half * last;
        exerted = given - stiffness.cwiseProduct(without - slack) - damping.cwiseProduct(rate_without);
        last = pinocchio::aba(model, data, ahead, rate_ahead, exerted, frame);
        angle = without + quarter * last;
        rate = rate_without + half * last;
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (end.tv_sec - begin.tv_sec) + 1e-9 * (end.tv_nsec - begin.tv_nsec);
}
