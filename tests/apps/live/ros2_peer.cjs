// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// Hears a transform by an implementation of ROS 2 that is not ours, and prints it. It only hears
// writers that keep what they sent for those who come later; yet what was sent before it came it
// asks for at a port where Fast DDS does not listen for that.
//   node ros2_peer.cjs DOMAIN
const {parse} = require('@foxglove/rosmsg');
const {RosNode} = require('@foxglove/ros2');
const {UdpSocketNode} = require('@foxglove/ros2/nodejs');

const message = (type, fields) => `${'='.repeat(80)}\nMSG: ${type}\n${fields}\n`;
const transforms = 'geometry_msgs/TransformStamped[] transforms\n' +
    message('geometry_msgs/TransformStamped',
            'std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform') +
    message('std_msgs/Header', 'time stamp\nstring frame_id') +
    message('geometry_msgs/Transform',
            'geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation') +
    message('geometry_msgs/Vector3', 'float64 x\nfloat64 y\nfloat64 z') +
    message('geometry_msgs/Quaternion', 'float64 x\nfloat64 y\nfloat64 z\nfloat64 w');

const node = new RosNode({
  name: 'peer',
  domainId: Number(process.argv[2]),
  addresses: ['127.0.0.1'],
  udpSocketCreate: UdpSocketNode.Create,
});
node.start().then(() => {
  const fixed = node.subscribe({
    topic: '/tf_static',
    dataType: 'tf2_msgs/msg/TFMessage',
    msgDefinition: parse(transforms, {ros2: true}),
  });
  fixed.on('message', (_, {transforms: [first]}) => {
    const {translation: {x, y, z}, rotation: {w}} = first.transform;
    console.log(first.header.frame_id, first.child_frame_id, x, y, z, w);
    process.exit(0);
  });
});
setTimeout(() => process.exit(1), 30000);
